// SPDX-License-Identifier: Apache-2.0
#include "render/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "render/ticks.h"

namespace ifa {
namespace {

using testing::HasSubstr;
using testing::Not;

Chart chartOf(std::vector<std::pair<double, double>> points) {
  return {"A <title>",
          "a note",
          {"time, s", false, 0},
          {"Score", false, 0, 1},
          {{"one & all", ChartStyle::kMarkedLine, std::move(points)}},
          {{ChartGuide::Kind::kAcross, 0.5, "half"}}};
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Chart, NamesAxesSeriesAndGuides) {
  const std::string svg = chartSvg(chartOf({{0, 0}, {1, 0.25}, {4, 1}}));
  for (const char* text : {"A &lt;title&gt;", "a note", ">time, s<", ">Score<", "one &amp; all",
                           ">half<", "prefers-color-scheme:dark"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_EQ(count(svg, "class=\"mark c0\""), 4);  // three points, and the legend
  EXPECT_EQ(count(svg, "class=\"guide\""), 2);
  EXPECT_THAT(svg, HasSubstr(">0.4</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Chart, KeepsEndsThatWereAskedForAndWidensOthers) {
  const std::string svg = chartSvg(chartOf({{0, 0}, {10, 1}}));
  EXPECT_THAT(svg, HasSubstr("d=\"M72.0 404.0L"));  // 0, 0 lies in the corner
  EXPECT_THAT(svg, HasSubstr(">10</text>"));
  EXPECT_THAT(svg, HasSubstr("L731.9 64.0\""));  // 10 lies a little before the edge at 758.3
}

TEST(Chart, ShowsOnlyWhatItCan) {
  Chart chart = chartOf({{0, 0.5}, {-1, 0.5}, {std::numeric_limits<double>::infinity(), 0.5}});
  chart.x = {"size", true};
  EXPECT_THAT(chartSvg(chart), HasSubstr("nothing to show"));
  chart.series[0].points.emplace_back(1000, 0.5);
  chart.series[0].points.emplace_back(4000000, 0.5);
  const std::string svg = chartSvg(chart);
  EXPECT_THAT(svg, HasSubstr(">100 k</text>"));
  EXPECT_THAT(svg, HasSubstr(">1 M</text>"));
  EXPECT_EQ(count(svg, "class=\"mark c0\""), 3);
}

TEST(Chart, NamesPlacesFromTheTop) {
  Chart chart = chartOf({{0.2, 0}, {0.9, 1}});
  chart.y = {"", false, {}, {}, {"first", "second"}};
  chart.series[0].style = ChartStyle::kMarks;
  chart.guides.clear();
  const std::string svg = chartSvg(chart);
  EXPECT_LT(svg.find(">first<"), svg.find(">second<"));
  EXPECT_EQ(count(svg, "class=\"line"), 0);
}

TEST(Chart, CumulativeShareEndsAtOne) {
  const ChartSeries few = cumulativeShare("few", {3, 1, 2, 2});
  EXPECT_THAT(few.points, testing::ElementsAre(testing::Pair(1, 0), testing::Pair(1, 0.25),
                                               testing::Pair(2, 0.5), testing::Pair(2, 0.75),
                                               testing::Pair(3, 1)));
  std::vector<double> many(100000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i);
  const ChartSeries line = cumulativeShare("many", many);
  EXPECT_LT(line.points.size(), 400u);
  EXPECT_EQ(line.points.back(), std::pair(99999.0, 1.0));
  EXPECT_TRUE(cumulativeShare("none", {}).points.empty());
}

TEST(Ticks, AreRound) {
  EXPECT_DOUBLE_EQ(tickStep(1, 8), 0.2);
  EXPECT_DOUBLE_EQ(tickStep(80, 8), 10);
  EXPECT_DOUBLE_EQ(tickStep(0.03, 10), 0.005);
}

}  // namespace
}  // namespace ifa
