// SPDX-License-Identifier: Apache-2.0
#include "pipeline/check_settings.h"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "body/body.h"

namespace ifa {

namespace {

tl::unexpected<Error> usage(std::string message, std::string place, std::string remedy) {
  return tl::unexpected<Error>(
      {ErrorCode::kUsage, std::move(message), std::move(place), std::move(remedy)});
}

Result<void> checkRange(double value, double low, double high, const char* place) {
  if (std::isfinite(value) && value >= low && value <= high) return {};
  return usage("is out of range", place, fmt::format("give a number from {:g} to {:g}", low, high));
}

}  // namespace

Result<void> checkSettings(const SynchronizeSettings& settings) {
  if (auto good = checkRange(settings.takes, 1, kMaxTakes, "takes"); !good) return good;
  if (auto good = checkRange(settings.timeLimitSeconds, 0, 1e6, "time limit"); !good) return good;
  if (auto good = checkRange(settings.energyGain, 0, 10, "energy gain"); !good) return good;
  if (auto good = checkRange(settings.graph.earlyExit, 0, 1, "early exit"); !good) return good;
  if (auto good = checkRange(settings.restitution.value_or(0), 0, kMostRestitution, "restitution");
      !good) {
    return good;
  }
  if (auto good = checkRange(settings.restitutionScale, 0.1, 10, "restitution scale"); !good) {
    return good;
  }
  if (settings.fit && settings.planner == "graph") {
    return usage("does not go with the planner graph, whose database holds one restitution", "fit",
                 "use --planner hybrid");
  }
  return checkRange(settings.preRollSeconds, 0, 10, "pre-roll");
}

}  // namespace ifa
