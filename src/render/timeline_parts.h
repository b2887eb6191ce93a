// SPDX-License-Identifier: Apache-2.0
// What the parts of the timeline picture share: layout, colours, and the time that is shown.
#pragma once

#include <algorithm>
#include <string>

#include "ifa/motion.h"
#include "render/svg_text.h"

namespace ifa::timeline_detail {

// Layout, in the picture's own units.
inline constexpr double kWidth = 1200, kHeight = 640;
inline constexpr double kLeft = 96, kRight = 24, kPlot = kWidth - kLeft - kRight;
inline constexpr double kWaveTop = 84, kWaveHeight = 150;
inline constexpr double kForceTop = 250, kForceBottom = 390;
inline constexpr double kTableTop = 454, kRowHeight = 18;
inline constexpr double kLegend = 620;
// Beyond this many contacts a table of factors has no room, on the page or in the file.
inline constexpr std::size_t kMostColumns = 240;

/// The part of the sound's time that is shown, s in the file.
struct View {
  double from = 0, to = 1;

  [[nodiscard]] double x(double time) const {
    return kLeft + kPlot * std::clamp((time - from) / (to - from), 0.0, 1.0);
  }
};

/// From teal (good, 0) over amber (1) to red (2 and more), for light and dark pages alike.
[[nodiscard]] std::string colour(double badness);

/// Bend and factors, one column a contact, evenly spaced, with lines up to the contacts' times;
/// nothing when there are too many.
void addTable(const Motion& motion, const View& view, SvgText& svg);

/// What the signs and colours mean.
void addLegend(SvgText& svg);

}  // namespace ifa::timeline_detail
