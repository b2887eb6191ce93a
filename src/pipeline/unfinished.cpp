// SPDX-License-Identifier: Apache-2.0
// Stand-ins for stages that are declared but not yet there, so that the program links. Each goes
// when its stage comes.
#include "audit/audit.h"
#include "motion/build_motion.h"
#include "planner/planner.h"
#include "render/timeline.h"

namespace ifa {

namespace {

tl::unexpected<Error> missing(const char* what) {
  return tl::unexpected<Error>(
      {ErrorCode::kInternal, std::string(what) + " is not there yet", {}, {}});
}

}  // namespace

[[gnu::weak]] Result<std::unique_ptr<Planner>> makePlanner(const std::string&) {
  return missing("the planner");
}
[[gnu::weak]] Result<Motion> buildMotion(const PlanRequest&, const Plan&, double) {
  return missing("the motion builder");
}
[[gnu::weak]] AuditReport audit(const Motion&, const Body&, const AuditSettings&) { return {}; }
[[gnu::weak]] Result<void> writeTimeline(const std::filesystem::path&, const Motion&,
                                         const Sound&) {
  return {};
}

}  // namespace ifa
