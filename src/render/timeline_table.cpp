// SPDX-License-Identifier: Apache-2.0
// The lower half of the timeline picture: the table of factors and the legend.
#include <array>
#include <cmath>

#include "render/timeline_parts.h"

namespace ifa::timeline_detail {
namespace {

struct Row {
  const char* name;
  double (*badness)(const MotionContact&);  ///< 0 good, 1 doubtful, 2 bad
};

double badFactor(double factor) { return 2 * (1 - std::clamp(factor, 0.0, 1.0)); }

constexpr Row kRows[] = {
    {"bend", [](const MotionContact& c) { return c.bend; }},
    {"velocity", [](const MotionContact& c) { return badFactor(c.factors.v); }},
    {"orientation", [](const MotionContact& c) { return badFactor(c.factors.q); }},
    {"time warp", [](const MotionContact& c) { return badFactor(c.factors.t); }},
    {"amplitude", [](const MotionContact& c) { return badFactor(c.factors.a); }},
    {"duration", [](const MotionContact& c) { return badFactor(c.factors.l); }},
    {"centroid", [](const MotionContact& c) { return badFactor(c.factors.c); }},
};

}  // namespace

std::string colour(double badness) {
  constexpr std::array<std::array<double, 3>, 3> kStops = {
      {{15, 148, 136}, {245, 158, 11}, {220, 38, 38}}};
  const double at = std::clamp(badness, 0.0, 1.999);
  const auto stop = static_cast<std::size_t>(at);
  const double share = at - static_cast<double>(stop);
  const auto mix = [&](std::size_t i) {
    return static_cast<int>(
        std::lround((1 - share) * kStops[stop][i] + share * kStops[stop + 1][i]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

void addTable(const Motion& motion, const View& view, SvgText& svg) {
  const std::size_t count = motion.contacts.size();
  if (count == 0 || count > kMostColumns) return;
  const double pitch = std::min(64.0, kPlot / static_cast<double>(count));
  const double left = kLeft + (kPlot - pitch * static_cast<double>(count)) / 2;
  const double width = pitch > 6 ? pitch - 2 : pitch;
  double y = kTableTop;
  for (const Row& row : kRows) {
    svg.label("text", kLeft - 10, y + 13, "end", row.name);
    for (std::size_t i = 0; i < count; ++i) {
      svg.add("<path fill=\"{}\" d=\"M{:.1f} {:.0f}h{:.1f}v16h-{:.1f}z\"/>",
              colour(row.badness(motion.contacts[i])), left + pitch * static_cast<double>(i), y,
              width, width);
    }
    y += kRowHeight;
  }
  const std::size_t every = pitch >= 18 ? 1 : pitch >= 9 ? 5 : 10;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = left + pitch * static_cast<double>(i) + width / 2;
    const double from = view.x(motion.sound.firstContact + motion.contacts[i].time);
    svg.add("<path class=\"link\" d=\"M{:.1f} {:.0f}L{:.1f} {:.0f}V{:.0f}\"/>", from,
            kForceBottom + 20, x, kTableTop - 10, kTableTop - 2);
    if ((i + 1) % every == 0 || i == 0) {
      svg.label("faint", x, y + 11, "middle", std::to_string(i + 1));
    }
  }
}

void addLegend(SvgText& svg) {
  svg.line("mark", kLeft, kLegend - 10, kLeft, kLegend + 2);
  svg.label("faint", kLeft + 8, kLegend, "start", "contact in the sound");
  svg.add("<circle class=\"goal\" cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"5.5\"/>", kLeft + 150,
          kLegend - 4);
  svg.label("faint", kLeft + 162, kLegend, "start", "its loudness");
  svg.add("<circle fill=\"{}\" cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"3.5\"/>", colour(0), kLeft + 260,
          kLegend - 4);
  svg.label("faint", kLeft + 270, kLegend, "start", "impulse of the motion's contact");
  svg.line("silent", kLeft + 460, kLegend - 4, kLeft + 490, kLegend - 4);
  svg.label("faint", kLeft + 498, kLegend, "start", "touching without a sound");
  constexpr int kSteps = 20;
  const double left = kLeft + kPlot - 330;
  svg.label("faint", left - 8, kLegend, "end", "factor 1, bend 0");
  for (int i = 0; i < kSteps; ++i) {
    svg.add("<path fill=\"{}\" d=\"M{:.1f} {:.0f}h10.5v10h-10.5z\"/>",
            colour(2.0 * i / (kSteps - 1)), left + 10 * i, kLegend - 10);
  }
  svg.label("faint", left + 10 * kSteps + 8, kLegend, "start", "factor 0, bend 2");
}

}  // namespace ifa::timeline_detail
