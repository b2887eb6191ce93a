// SPDX-License-Identifier: Apache-2.0
#include "render/timeline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/file.h"
#include "render/svg_text.h"

namespace ifa {
namespace {

// Layout, in the picture's own units.
constexpr double kWidth = 1200, kHeight = 640;
constexpr double kLeft = 96, kRight = 24, kPlot = kWidth - kLeft - kRight;
constexpr double kWaveTop = 84, kWaveHeight = 150;
constexpr double kForceTop = 250, kForceBottom = 390;
constexpr double kTableTop = 454, kRowHeight = 18;
constexpr double kLegend = 620;
// Beyond this many contacts a table of factors has no room, on the page or in the file.
constexpr std::size_t kMostColumns = 240;

constexpr std::string_view kStyle = R"(<style>
svg{font-family:system-ui,-apple-system,"Segoe UI","DejaVu Sans",sans-serif;font-size:12px}
.page{fill:#fff}.title{fill:#111827;font-size:18px;font-weight:600}
.text{fill:#374151}.faint{fill:#6b7280;font-size:11px}.bad{fill:#b91c1c}
.panel{fill:#f8fafc}.grid{stroke:#e2e8f0;fill:none}.axis{stroke:#94a3b8;fill:none}
.wave{fill:#7c8aa0}.region{fill:#2563eb;opacity:.22}.mark{stroke:#2563eb;stroke-width:1.2;fill:none}
.goal{stroke:#2563eb;stroke-width:1.6;fill:none}.link{stroke:#cbd5e1;fill:none}
.silent{stroke:#94a3b8;stroke-width:2;stroke-dasharray:3 3;fill:none}
@media (prefers-color-scheme:dark){
.page{fill:#0f172a}.title{fill:#f1f5f9}.text{fill:#cbd5e1}.faint{fill:#94a3b8}.bad{fill:#fca5a5}
.panel{fill:#1a2438}.grid{stroke:#2b384f}.axis{stroke:#64748b}.wave{fill:#7387a3}
.region{fill:#60a5fa;opacity:.25}.mark,.goal{stroke:#60a5fa}.link{stroke:#475569}
.silent{stroke:#64748b}}
</style>
)";

/// From teal (good, 0) over amber (1) to red (2 and more), for light and dark pages alike.
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

/// The part of the sound's time that is shown, s in the file.
struct View {
  double from = 0, to = 1;

  [[nodiscard]] double x(double time) const {
    return kLeft + kPlot * std::clamp((time - from) / (to - from), 0.0, 1.0);
  }
};

View chooseView(const Motion& motion) {
  constexpr double kBefore = 0.25, kAfter = 0.35;  // s around the contacts
  const double origin = motion.sound.firstContact;
  double first = origin, last = origin;
  for (const MotionContact& contact : motion.contacts) {
    first = std::min(first, origin + std::min(contact.time, contact.targetTime));
    last = std::max(
        {last, origin + contact.end, origin + contact.targetTime + contact.targetDuration});
  }
  const double from = std::max(0.0, first - kBefore);
  return {from, std::max(last + kAfter, from + 0.1)};
}

void addCaption(const Motion& motion, SvgText& svg) {
  svg.label("title", kLeft, 34, "start",
            fmt::format("{} on {}: Score {:.2f}", motion.object.name, motion.object.surface,
                        motion.score));
  const bool terminal = !motion.contacts.empty() && motion.contacts.back().terminal;
  svg.label("text", kLeft, 56, "start",
            fmt::format("{} contacts, {} \u00b7 without sound {:.2f} \u00b7 mean f\u1d65 {:.2f} "
                        "\u00b7 bend: median {:.2f}, largest {:.2f} \u00b7 {}",
                        motion.contacts.size(), terminal ? "comes to rest" : "goes on",
                        motion.scoreWithoutSound, motion.meanFv, motion.bend.median,
                        motion.bend.max, motion.sound.file));
  if (motion.success) return;
  constexpr std::size_t kRoom = 150;
  std::string why = "No acceptable motion: " + motion.failure;
  if (why.size() > kRoom) why = why.substr(0, kRoom - 3) + "...";
  svg.label("bad", kLeft, 74, "start", why);
}

/// Largest and smallest sample per column, as one closed outline.
void addWaveform(const Sound& sound, const View& view, SvgText& svg) {
  if (sound.samples.empty() || sound.rate <= 0) return;
  const auto count = static_cast<double>(sound.samples.size());
  const auto index = [&](double time) {
    return static_cast<std::size_t>(std::clamp(std::round(time * sound.rate), 0.0, count));
  };
  const auto begin = sound.samples.begin();
  const auto shown = std::minmax_element(begin + static_cast<std::ptrdiff_t>(index(view.from)),
                                         begin + static_cast<std::ptrdiff_t>(index(view.to)));
  if (shown.first == sound.samples.end()) return;
  const double peak =
      std::max({1e-9, static_cast<double>(*shown.second), -static_cast<double>(*shown.first)});
  const double middle = kWaveTop + kWaveHeight / 2, scale = kWaveHeight / 2 * 0.96 / peak;
  std::string outline;
  std::vector<std::string> bottom;
  for (double column = 0; column < kPlot; ++column) {
    const double step = (view.to - view.from) / kPlot, time = view.from + column * step;
    const std::size_t from = index(time), to = std::max(from + 1, index(time + step));
    if (to > sound.samples.size()) break;
    const auto range = std::minmax_element(begin + static_cast<std::ptrdiff_t>(from),
                                           begin + static_cast<std::ptrdiff_t>(to));
    const double x = kLeft + column;
    outline += fmt::format("{}{:.0f} {:.1f}", column > 0 ? "L" : "M", x,
                           middle - scale * static_cast<double>(*range.second));
    bottom.push_back(
        fmt::format("L{:.0f} {:.1f}", x, middle - scale * static_cast<double>(*range.first) + 0.3));
  }
  for (auto point = bottom.rbegin(); point != bottom.rend(); ++point) outline += *point;
  svg.add("<path class=\"wave\" d=\"{}Z\"/>", outline);
}

void addPanels(const View& view, SvgText& svg) {
  svg.rectangle("panel", kLeft, kWaveTop, kPlot, kWaveHeight);
  svg.rectangle("panel", kLeft, kForceTop, kPlot, kForceBottom - kForceTop);
  svg.label("text", kLeft - 10, kWaveTop + kWaveHeight / 2 + 4, "end", "sound");
  svg.label("text", kLeft - 10, (kForceTop + kForceBottom) / 2 + 4, "end", "motion");
  const double rough = (view.to - view.from) / 8;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double step = power * (rough / power < 2 ? 1 : rough / power < 5 ? 2 : 5);
  for (double time = std::ceil(view.from / step) * step; time <= view.to; time += step) {
    svg.line("grid", view.x(time), kWaveTop, view.x(time), kForceBottom);
    svg.label("faint", view.x(time), kForceBottom + 15, "middle", fmt::format("{:.3g} s", time));
  }
  svg.line("axis", kLeft, kForceBottom, kLeft + kPlot, kForceBottom);
}

void addTargets(const Motion& motion, const View& view, SvgText& svg) {
  for (const MotionContact& contact : motion.contacts) {
    const double start = motion.sound.firstContact + contact.targetTime;
    const double x = view.x(start), width = view.x(start + contact.targetDuration) - x;
    if (width > 0) svg.rectangle("region", x, kWaveTop, width, kWaveHeight);
    svg.line("mark", x, kWaveTop, x, kForceTop);
  }
}

double largestAmplitude(const Motion& motion) {
  double largest = 1e-9;
  for (const MotionContact& contact : motion.contacts) {
    largest = std::max({largest, contact.amplitude, contact.targetAmplitude});
  }
  return largest;
}

/// A stem for what the motion does, a ring for what the sound asks.
void addContacts(const Motion& motion, const View& view, SvgText& svg) {
  const double origin = motion.sound.firstContact;
  const double scale = (kForceBottom - kForceTop - 16) / largestAmplitude(motion);
  for (const auto& interval : motion.silent) {
    const double from = view.x(origin + interval[0]), to = view.x(origin + interval[1]);
    if (to - from >= 1) svg.line("silent", from, kForceBottom - 3, to, kForceBottom - 3);
  }
  for (std::size_t i = 0; i < motion.contacts.size(); ++i) {
    const MotionContact& contact = motion.contacts[i];
    const double x = view.x(origin + contact.time);
    const double width = std::max(3.0, view.x(origin + contact.end) - x);
    const double height = scale * contact.amplitude, goal = scale * contact.targetAmplitude;
    const std::string fill = colour(contact.bend);
    svg.add("<g><title>contact {}: {:.4f} s, amplitude {:.2f} for {:.2f}, bend {:.2f}</title>",
            i + 1, origin + contact.time, contact.amplitude, contact.targetAmplitude, contact.bend);
    svg.add("<path fill=\"{}\" d=\"M{:.1f} {:.1f}h3v{:.1f}h-3z\"/>", fill, x - 1.5,
            kForceBottom - height, height);
    svg.add("<path fill=\"{}\" opacity=\".55\" d=\"M{:.1f} {:.1f}h{:.1f}v6h-{:.1f}z\"/>", fill, x,
            kForceBottom - 6, width, width);
    svg.add("<circle fill=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>", fill, x,
            kForceBottom - height);
    svg.add("<circle class=\"goal\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5.5\"/></g>", x,
            kForceBottom - goal);
  }
}

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

/// One column a contact, evenly spaced: contacts can be two milliseconds apart.
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

}  // namespace

std::string timelineSvg(const Motion& motion, const Sound& sound) {
  SvgText svg;
  svg.add(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" "
      "height=\"{}\" role=\"img\">",
      kWidth, kHeight, kWidth, kHeight);
  svg.add("<title>{}</title>", escapeXml("Timeline of " + motion.object.name));
  svg.raw(kStyle);
  svg.rectangle("page", 0, 0, kWidth, kHeight);
  const View view = chooseView(motion);
  addCaption(motion, svg);
  addPanels(view, svg);
  addWaveform(sound, view, svg);
  addTargets(motion, view, svg);
  addContacts(motion, view, svg);
  addTable(motion, view, svg);
  addLegend(svg);
  svg.raw("</svg>\n");
  return svg.text();
}

Result<void> writeTimeline(const std::filesystem::path& path, const Motion& motion,
                           const Sound& sound) {
  return writeFileAtomically(path, timelineSvg(motion, sound));
}

}  // namespace ifa
