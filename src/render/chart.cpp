// SPDX-License-Identifier: Apache-2.0
#include "render/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/svg_text.h"
#include "render/ticks.h"

namespace ifa {
namespace {

// Layout, in the picture's own units.
constexpr double kWidth = 900, kTop = 64, kBottom = 58, kPlotHeight = 340;
constexpr double kLeft = 72, kLeftOfNames = 178, kNamedRow = 19;
constexpr double kLegendGap = 20, kLegendText = 36, kLetter = 7.3, kMostLegend = 360;
constexpr std::size_t kKinds = 8;        // of colours, marks and dashes
constexpr std::size_t kMostSteps = 300;  // of a cumulative line

constexpr std::string_view kStyle = R"(<style>
svg{font-family:system-ui,-apple-system,"Segoe UI","DejaVu Sans",sans-serif;font-size:13px}
.page{fill:#fff}.title{fill:#111827;font-size:17px;font-weight:600}
.text{fill:#374151}.faint{fill:#6b7280;font-size:12px}
.panel{fill:#f8fafc}.grid{stroke:#e2e8f0;fill:none}.axis{stroke:#94a3b8;fill:none}
.guide{stroke:#64748b;stroke-dasharray:2 4;fill:none}
.line{fill:none;stroke-width:2;stroke-linejoin:round}.mark{stroke-width:1.4;fill-opacity:.45}
.c0{color:#2563eb}.c1{color:#c2570c}.c2{color:#047857}.c3{color:#be185d}
.c4{color:#7c3aed}.c5{color:#0e7490}.c6{color:#854d0e}.c7{color:#4b5563}
.line,.mark{stroke:currentColor}.mark{fill:currentColor}
@media (prefers-color-scheme:dark){
.page{fill:#0f172a}.title{fill:#f1f5f9}.text{fill:#cbd5e1}.faint{fill:#94a3b8}
.panel{fill:#1a2438}.grid{stroke:#2b384f}.axis{stroke:#64748b}.guide{stroke:#94a3b8}
.c0{color:#60a5fa}.c1{color:#fb923c}.c2{color:#34d399}.c3{color:#f472b6}
.c4{color:#a78bfa}.c5{color:#22d3ee}.c6{color:#facc15}.c7{color:#d1d5db}}
</style>
)";

/// One axis laid out: from values to shares of its length.
class Scale {
 public:
  Scale(const ChartAxis& axis, const std::vector<double>& values) : axis_(axis) {
    low_ = axis.low.value_or(std::numeric_limits<double>::max());
    high_ = axis.high.value_or(std::numeric_limits<double>::lowest());
    for (const double value : values) {
      if (!shows(value)) continue;
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    }
    if (!axis.names.empty()) {
      low_ = -0.6;
      high_ = static_cast<double>(axis.names.size()) - 0.4;
    }
    if (low_ > high_) low_ = high_ = axis.logarithmic ? 1 : 0;
    widen();
  }

  [[nodiscard]] bool shows(double value) const {
    return std::isfinite(value) && (!axis_.logarithmic || value > 0);
  }
  /// 0 at the low end, 1 at the high one.
  [[nodiscard]] double share(double value) const {
    return axis_.logarithmic ? std::log(value / low_) / std::log(high_ / low_)
                             : (value - low_) / (high_ - low_);
  }
  [[nodiscard]] bool contains(double value) const {
    return shows(value) && value >= low_ && value <= high_;
  }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// Values with their texts.
  [[nodiscard]] std::vector<std::pair<double, std::string>> ticks() const {
    std::vector<std::pair<double, std::string>> ticks;
    if (!axis_.names.empty()) {
      for (const std::string& name : axis_.names)
        ticks.emplace_back(static_cast<double>(ticks.size()), name);
    } else if (axis_.logarithmic) {
      const bool fine = high_ / low_ < 300;
      for (double power = std::pow(10, std::floor(std::log10(low_))); power <= high_; power *= 10) {
        for (const double digit : {1.0, 2.0, 5.0}) {
          const double value = digit * power;
          if ((fine || digit < 2) && contains(value)) ticks.emplace_back(value, textOf(value));
        }
      }
    } else {
      const double step = tickStep(high_ - low_, 8);
      const auto first = static_cast<long>(std::ceil(low_ / step - 1e-9));
      const auto last = static_cast<long>(std::floor(high_ / step + 1e-9));
      for (long i = first; i <= last; ++i) {
        const double value = static_cast<double>(i) * step;
        ticks.emplace_back(value, textOf(value));
      }
    }
    return ticks;
  }

 private:
  /// Data do not touch the frame, but ends that were asked for are kept.
  void widen() {
    constexpr double kMargin = 0.04;
    if (!axis_.names.empty()) return;
    if (axis_.logarithmic) {
      const double factor = high_ > low_ ? std::pow(high_ / low_, kMargin) : 2;
      if (axis_.low != low_) low_ /= factor;
      if (axis_.high != high_) high_ *= factor;
    } else {
      const double margin = high_ > low_ ? kMargin * (high_ - low_) : 0.5;
      if (axis_.low != low_) low_ -= margin;
      if (axis_.high != high_) high_ += margin;
    }
    if (!(low_ < high_)) high_ = axis_.logarithmic ? 2 * low_ : low_ + 1;
  }
  static std::string textOf(double value) {
    if (std::abs(value) < 10000) return fmt::format("{:.6g}", value);
    return value < 1e6 ? fmt::format("{:.6g} k", value / 1e3)
                       : fmt::format("{:.6g} M", value / 1e6);
  }

  const ChartAxis& axis_;
  double low_ = 0, high_ = 1;
};

std::vector<double> valuesOf(const Chart& chart, bool ofX) {
  std::vector<double> values;
  for (const ChartSeries& series : chart.series) {
    for (const auto& [x, y] : series.points) values.push_back(ofX ? x : y);
  }
  return values;
}

double legendWidth(const Chart& chart) {
  std::size_t longest = 8;
  for (const ChartSeries& series : chart.series) longest = std::max(longest, series.name.size());
  for (const ChartGuide& guide : chart.guides) longest = std::max(longest, guide.name.size());
  return std::min(kMostLegend,
                  2 * kLegendGap + kLegendText + kLetter * static_cast<double>(longest));
}

class ChartWriter {
 public:
  explicit ChartWriter(const Chart& chart)
      : chart_(chart),
        x_(chart.x, valuesOf(chart, true)),
        y_(chart.y, valuesOf(chart, false)),
        left_(chart.y.names.empty() ? kLeft : kLeftOfNames),
        right_(legendWidth(chart)),
        width_(kWidth - left_ - right_),
        height_(chart.y.names.empty()
                    ? kPlotHeight
                    : std::max(120.0, kNamedRow * static_cast<double>(chart.y.names.size()))) {}

  std::string write() {
    const double all = kTop + height_ + kBottom;
    svg_.add(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" "
        "height=\"{}\" role=\"img\">",
        kWidth, all, kWidth, all);
    svg_.add("<title>{}</title>", escapeXml(chart_.title));
    svg_.raw(kStyle);
    svg_.rectangle("page", 0, 0, kWidth, all);
    svg_.label("title", left_, 28, "start", chart_.title);
    svg_.label("faint", left_, 48, "start", chart_.note);
    svg_.rectangle("panel", left_, kTop, width_, height_);
    axes();
    guides();
    bool any = false;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) any = series(i) || any;
    if (!any)
      svg_.label("text", left_ + width_ / 2, kTop + height_ / 2, "middle", "nothing to show");
    legend();
    svg_.raw("</svg>\n");
    return svg_.text();
  }

 private:
  [[nodiscard]] double px(double x) const { return left_ + width_ * x_.share(x); }
  [[nodiscard]] double py(double y) const {
    const double share = y_.share(y);  // names read from the top
    return kTop + height_ * (chart_.y.names.empty() ? 1 - share : share);
  }

  void axes() {
    const double bottom = kTop + height_;
    for (const auto& [value, text] : x_.ticks()) {
      svg_.line("grid", px(value), kTop, px(value), bottom);
      svg_.label("faint", px(value), bottom + 17, "middle", text);
    }
    for (const auto& [value, text] : y_.ticks()) {
      svg_.line("grid", left_, py(value), left_ + width_, py(value));
      svg_.label("faint", left_ - 8, py(value) + 4, "end", text);
    }
    svg_.line("axis", left_, bottom, left_ + width_, bottom);
    svg_.line("axis", left_, kTop, left_, bottom);
    svg_.label("text", left_ + width_ / 2, bottom + 42, "middle", chart_.x.label);
    const double middle = kTop + height_ / 2;
    svg_.add(
        "<text class=\"text\" transform=\"translate(18 {:.1f}) rotate(-90)\" "
        "text-anchor=\"middle\">{}</text>",
        middle, escapeXml(chart_.y.label));
  }

  void guides() {
    for (const ChartGuide& guide : chart_.guides) {
      if (guide.kind == ChartGuide::Kind::kUp && x_.contains(guide.at)) {
        svg_.line("guide", px(guide.at), kTop, px(guide.at), kTop + height_);
      } else if (guide.kind == ChartGuide::Kind::kAcross && y_.contains(guide.at)) {
        svg_.line("guide", left_, py(guide.at), left_ + width_, py(guide.at));
      } else if (guide.kind == ChartGuide::Kind::kDiagonal) {
        const double from = std::max(x_.low(), y_.low()), to = std::min(x_.high(), y_.high());
        if (from < to) svg_.line("guide", px(from), py(from), px(to), py(to));
      }
    }
  }

  void mark(std::size_t kind, double x, double y) {
    static constexpr std::array<const char*, kKinds> kPaths = {
        "m-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z",
        "m-3.2-3.2h6.4v6.4h-6.4z",
        "m0-4.4l4 7h-8z",
        "m0-4.5l4.5 4.5l-4.5 4.5l-4.5-4.5z",
        "m0 4.4l4-7h-8z",
        "m-3.5-3.5l7 7m0-7l-7 7",
        "m-4.2 0h8.4m-4.2-4.2v8.4",
        "m-4 0l2-3.5h4l2 3.5l-2 3.5h-4z"};
    svg_.add("<path class=\"mark c{}\" d=\"M{:.1f} {:.1f}{}\"/>", kind, x, y, kPaths[kind]);
  }

  void line(std::size_t kind, bool dashed, const std::string& path) {
    static constexpr std::array<const char*, kKinds> kDashes = {"none", "9 4", "3 3",  "12 3 3 3",
                                                                "6 2",  "2 5", "14 4", "1 3"};
    svg_.add("<path class=\"line c{}\" stroke-dasharray=\"{}\" d=\"{}\"/>", kind,
             dashed ? kDashes[kind] : "none", path);
  }

  /// False where there was nothing to draw.
  bool series(std::size_t number) {
    const ChartSeries& series = chart_.series[number];
    const std::size_t kind = number % kKinds;
    std::string path;
    std::vector<std::pair<double, double>> places;
    for (const auto& [x, y] : series.points) {
      if (!x_.shows(x) || !y_.shows(y)) continue;
      places.emplace_back(px(x), py(y));
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", places.back().first,
                          places.back().second);
    }
    if (places.empty()) return false;
    if (series.style != ChartStyle::kMarks) line(kind, series.style == ChartStyle::kLine, path);
    if (series.style != ChartStyle::kLine) {
      for (const auto& [x, y] : places) mark(kind, x, y);
    }
    return true;
  }

  void legend() {
    const double x = kWidth - right_ + kLegendGap;
    double y = kTop + 14;
    for (std::size_t i = 0; i < chart_.series.size(); ++i, y += 22) {
      const ChartStyle style = chart_.series[i].style;
      if (style != ChartStyle::kMarks)
        line(i % kKinds, style == ChartStyle::kLine, fmt::format("M{} {}h28", x, y - 4));
      if (style != ChartStyle::kLine) mark(i % kKinds, x + 14, y - 4);
      svg_.label("text", x + kLegendText, y, "start", chart_.series[i].name);
    }
    for (const ChartGuide& guide : chart_.guides) {
      if (guide.name.empty()) continue;
      svg_.line("guide", x, y - 4, x + 28, y - 4);
      svg_.label("text", x + kLegendText, y, "start", guide.name);
      y += 22;
    }
  }

  const Chart& chart_;
  Scale x_, y_;
  double left_, right_, width_, height_;
  SvgText svg_;
};

}  // namespace

std::string chartSvg(const Chart& chart) { return ChartWriter(chart).write(); }

ChartSeries cumulativeShare(std::string name, std::vector<double> values) {
  ChartSeries series{std::move(name), ChartStyle::kLine, {}};
  if (values.empty()) return series;
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  series.points.emplace_back(values.front(), 0);
  const std::size_t steps = std::min(count, kMostSteps);
  for (std::size_t i = 1; i <= steps; ++i) {
    const std::size_t rank = i * count / steps;
    series.points.emplace_back(values[rank - 1],
                               static_cast<double>(rank) / static_cast<double>(count));
  }
  return series;
}

}  // namespace ifa
