#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace foresight {

struct ChartAxis {
  std::string title;
  std::string unit;          ///< shown behind the title; may be empty
  bool logarithmic = false;  ///< values that are not positive are then gaps
  bool from_zero = false;    ///< linear axes only: 0 is always on it
  bool whole_numbers = false;
};

struct ChartSeries {
  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< in drawing order; a NaN or infinity is a gap
};

/// Lines over two axes that fit the finite points; a legend where there are several series.
struct LineChart {
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
  int width = 640;
  int height = 400;
};

/// The chart as SVG text of its own: no scripts, fonts or files from elsewhere. The same chart
/// gives the same bytes everywhere. Runs of points are <polyline>, each point a <circle>; the frame
/// is <rect class="frame">. Without any finite point the chart says "no data".
std::string SvgOf(const LineChart& chart);

}  // namespace foresight
