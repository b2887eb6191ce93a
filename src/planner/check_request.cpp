// SPDX-License-Identifier: Apache-2.0
#include "planner/check_request.h"

#include <fmt/format.h>

namespace ifa {

Result<void> checkRequest(const PlanRequest& request) {
  const auto& events = request.signature.events;
  if (events.empty()) {
    return badInput("the signature has no events", "signature", "mark at least one contact");
  }
  for (std::size_t i = 1; i < events.size(); ++i) {
    if (!(events[i].time > events[i - 1].time)) {
      return badInput("events are out of order", fmt::format("event {}", i + 1));
    }
  }
  return {};
}

}  // namespace ifa
