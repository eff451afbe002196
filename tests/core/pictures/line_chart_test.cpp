#include "core/pictures/line_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace foresight {
namespace {

using Pixels = std::vector<Eigen::Vector2d>;

int CountOf(const std::string& part, const std::string& text) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The places of the points' circles.
Pixels PointsIn(const std::string& svg) {
  static const std::regex kCircle(R"re(<circle cx="([-0-9.]+)" cy="([-0-9.]+)")re");
  Pixels points;
  for (std::sregex_iterator i(svg.begin(), svg.end(), kCircle), end; i != end; ++i)
    points.emplace_back(std::stod((*i)[1]), std::stod((*i)[2]));
  return points;
}

struct Frame {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
  Eigen::Vector2d At(double right, double up) const {
    return {left + right * width, top + (1.0 - up) * height};
  }
};

Frame FrameOf(const std::string& svg, const std::string& of = "frame") {
  const std::regex frame(
      "class=\"" + of +
      R"re(" x="([0-9.]+)" y="([0-9.]+)" width="([0-9.]+)" height="([0-9.]+)")re");
  std::smatch match;
  if (!std::regex_search(svg, match, frame)) return {};
  return {std::stod(match[1]), std::stod(match[2]), std::stod(match[3]), std::stod(match[4])};
}

/// The SVG has two decimals.
void ExpectNear(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  EXPECT_NEAR(a.x(), b.x(), 0.011);
  EXPECT_NEAR(a.y(), b.y(), 0.011);
}

LineChart ChartOf(std::vector<Eigen::Vector2d> points) {
  LineChart chart;
  chart.title = "A title";
  chart.x = {"pass", "", false, false, false};
  chart.y = {"change", "mm", false, false, false};
  chart.series = {{"one", std::move(points)}};
  return chart;
}

TEST(LineChart, PutsPointsWhereTheAxesSay) {
  const std::string svg = SvgOf(ChartOf({{0.0, 0.0}, {5.0, 50.0}, {10.0, 100.0}}));
  const Pixels points = PointsIn(svg);
  ASSERT_EQ(points.size(), 3u);
  ExpectNear(points[0], FrameOf(svg).At(0.0, 0.0));
  ExpectNear(points[1], FrameOf(svg).At(0.5, 0.5));
  ExpectNear(points[2], FrameOf(svg).At(1.0, 1.0));
  EXPECT_EQ(CountOf("<polyline", svg), 1);
  EXPECT_NE(svg.find(">change [mm]</text>"), std::string::npos);
}

TEST(LineChart, ALogarithmicAxisGivesEachDecadeTheSameLength) {
  LineChart chart = ChartOf({{0.0, 0.1}, {1.0, 1.0}, {2.0, 1000.0}});
  chart.y.logarithmic = true;
  const std::string svg = SvgOf(chart);
  const Pixels points = PointsIn(svg);
  ASSERT_EQ(points.size(), 3u);
  ExpectNear(points[1], FrameOf(svg).At(0.5, 0.25));
}

TEST(LineChart, AMissingValueIsAGapInTheLine) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::string svg =
      SvgOf(ChartOf({{0.0, 1.0}, {1.0, 2.0}, {2.0, kNaN}, {3.0, 2.0}, {4.0, 3.0}, {5.0, kNaN}}));
  EXPECT_EQ(CountOf("<polyline", svg), 2);
  EXPECT_EQ(PointsIn(svg).size(), 4u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(LineChart, WhatALogarithmicAxisDoesNotHaveIsAGap) {
  LineChart chart = ChartOf({{0.0, 1.0}, {1.0, 0.0}, {2.0, 10.0}});
  chart.y.logarithmic = true;
  EXPECT_EQ(PointsIn(SvgOf(chart)).size(), 2u);
}

TEST(LineChart, WithoutPointsSaysSo) {
  for (const bool logarithmic : {false, true}) {
    LineChart chart = ChartOf({});
    chart.y.logarithmic = logarithmic;
    EXPECT_NE(SvgOf(chart).find(">no data</text>"), std::string::npos);
  }
  EXPECT_EQ(SvgOf(ChartOf({{1.0, 1.0}})).find("no data"), std::string::npos);
}

TEST(LineChart, AnEmptySeriesKeepsItsPlaceInTheLegend) {
  LineChart chart = ChartOf({{0.0, 1.0}, {1.0, 2.0}});
  EXPECT_EQ(CountOf("class=\"legend\"", SvgOf(chart)), 0);
  chart.series.push_back({"two", {}});
  const std::string svg = SvgOf(chart);
  EXPECT_NE(svg.find(">two</text>"), std::string::npos);
  EXPECT_EQ(CountOf("<polyline", svg), 1);
}

TEST(LineChart, TheLegendStandsWhereItHidesNoLine) {
  const auto hidden = [](std::vector<Eigen::Vector2d> points) {
    LineChart chart = ChartOf(std::move(points));
    chart.series.push_back({"two", {}});
    const std::string svg = SvgOf(chart);
    const Frame legend = FrameOf(svg, "legend");
    int count = 0;
    for (const Eigen::Vector2d& point : PointsIn(svg))
      count += point.x() > legend.left && point.x() < legend.left + legend.width &&
               point.y() > legend.top && point.y() < legend.top + legend.height;
    EXPECT_GT(legend.width, 0.0);
    return count;
  };
  EXPECT_EQ(hidden({{0.0, 0.0}, {0.9, 0.9}, {1.0, 1.0}, {0.95, 0.95}}), 0);
  EXPECT_EQ(hidden({{0.0, 1.0}, {0.05, 0.95}, {0.9, 0.1}, {0.95, 0.95}}), 0);
}

TEST(LineChart, TextFromOutsideStaysText) {
  LineChart chart = ChartOf({{0.0, 1.0}});
  chart.title = "a < b & \"c\"";
  chart.series.push_back({"<script>", {}});
  const std::string svg = SvgOf(chart);
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
}

TEST(LineChart, TicksAreWholeWhereThatIsAskedFor) {
  LineChart chart = ChartOf({{1.0, 10.0}, {3.0, 20.0}});
  chart.x.whole_numbers = true;
  const std::string svg = SvgOf(chart);
  EXPECT_EQ(svg.find(".5</text>"), std::string::npos);
  for (const char* label : {">1</text>", ">2</text>", ">3</text>"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
}

TEST(LineChart, ZeroIsOnTheAxisWhereThatIsAskedFor) {
  LineChart chart = ChartOf({{0.0, 80.0}, {1.0, 100.0}});
  chart.y.from_zero = true;
  const std::string svg = SvgOf(chart);
  const Pixels points = PointsIn(svg);
  ASSERT_EQ(points.size(), 2u);
  ExpectNear(points[0], FrameOf(svg).At(0.0, 0.8));
}

}  // namespace
}  // namespace foresight
