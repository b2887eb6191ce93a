// SPDX-License-Identifier: Apache-2.0
#include "render/timeline.h"

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "render/svg_text.h"
#include "render/ticks.h"
#include "render/timeline_parts.h"

namespace ifa {
namespace {

using namespace timeline_detail;

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
  const double step = tickStep(view.to - view.from, 14);
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
