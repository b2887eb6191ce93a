// SPDX-License-Identifier: Apache-2.0
// Stand-ins for stages that are declared but not yet there, so that the program links. Each goes
// when its stage comes.
#include "motion/build_motion.h"

namespace ifa {

namespace {

tl::unexpected<Error> missing(const char* what) {
  return tl::unexpected<Error>(
      {ErrorCode::kInternal, std::string(what) + " is not there yet", {}, {}});
}

}  // namespace

[[gnu::weak]] Result<Motion> buildMotion(const PlanRequest&, const Plan&, double) {
  return missing("the motion builder");
}

}  // namespace ifa
