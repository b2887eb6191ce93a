// SPDX-License-Identifier: Apache-2.0
// Charts as SVG: points and lines over two axes, for light and dark pages.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ifa {

struct ChartAxis {
  std::string label = {};  ///< with the unit
  bool logarithmic = false;
  /// Ends of the axis; where they are not given, or the data go beyond, those of the data.
  std::optional<double> low = {}, high = {};
  std::vector<std::string> names = {};  ///< of the places 0, 1, ...: instead of numbers
};

enum class ChartStyle { kMarks, kLine, kMarkedLine };

struct ChartSeries {
  std::string name;  ///< in the legend
  ChartStyle style = ChartStyle::kMarks;
  std::vector<std::pair<double, double>> points = {};  ///< x, y; what no axis can show is left out
};

/// A dashed line across the chart.
struct ChartGuide {
  enum class Kind { kAcross, kUp, kDiagonal } kind = Kind::kAcross;  ///< y = at, x = at, y = x
  double at = 0;
  std::string name = {};
};

struct Chart {
  std::string title, note = {};  ///< note: a line under the title
  ChartAxis x, y;
  std::vector<ChartSeries> series = {};
  std::vector<ChartGuide> guides = {};
};

/// The picture. Series are told apart by colour and by mark or dashes; without any point it says
/// so.
[[nodiscard]] std::string chartSvg(const Chart& chart);

/// The share of `values` that are not above x, as a line from the smallest to the largest with few
/// enough points for a picture.
[[nodiscard]] ChartSeries cumulativeShare(std::string name, std::vector<double> values);

}  // namespace ifa
