// SPDX-License-Identifier: Apache-2.0
// Which contacts of a motion are events (docs/method.md 2).
#pragma once

#include <string_view>

namespace ifa {

/// Decision: events are audible events; the paper's own cut (IFA section 4) is for comparison.
enum class EventCut {
  kAudible,  ///< what is heard: impulses beyond what carries the weight, over a share of J_ref
  kPaper     ///< any impulse above zero, until the body rests
};

/// "audible" or "paper".
[[nodiscard]] constexpr std::string_view cutName(EventCut cut) {
  return cut == EventCut::kPaper ? "paper" : "audible";
}

/// The cut of that name; anything but "paper" is audible.
[[nodiscard]] constexpr EventCut cutNamed(std::string_view name) {
  return name == cutName(EventCut::kPaper) ? EventCut::kPaper : EventCut::kAudible;
}

}  // namespace ifa
