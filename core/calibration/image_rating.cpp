#include "core/calibration/image_rating.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/quantile.h"

namespace foresight {
namespace {

constexpr double kSaturated = 250.0;
constexpr double kLeastBoardContrast = 15.0;
/// Black squares lighter than this beside saturated white ones: the scale of greys is cut off.
constexpr double kLightestBlack = 110.0;
/// Beyond this fraction of a square, edges run into each other.
constexpr double kWidestEdge = 0.5;
constexpr double kFarthestSpill = 0.12;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double HullArea(std::vector<Eigen::Vector2d> points) {
  if (points.size() < 3) return 0.0;
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Eigen::Vector2d> hull;
  for (const int direction : {1, -1}) {
    const std::size_t begin = hull.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d& point = direction > 0 ? points[i] : points[points.size() - 1 - i];
      while (hull.size() >= begin + 2 &&
             Cross(hull[hull.size() - 2], hull[hull.size() - 1], point) <= 0.0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
  }
  double area = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d& a = hull[i];
    const Eigen::Vector2d& b = hull[(i + 1) % hull.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return std::abs(area);
}

/// An edge between two squares, along the line between their middles.
struct Edge {
  double width_px = 0.0;
  double spill_px = 0.0;  ///< from halfway, towards the dark square
};

std::optional<Edge> MeasureEdge(const GrayImage& image, const Eigen::Vector2d& dark,
                                const Eigen::Vector2d& light) {
  const double length = (light - dark).norm();
  const int steps = static_cast<int>(4.0 * length);  // a quarter of a pixel each
  if (steps < 12) return std::nullopt;
  std::vector<double> greys;
  for (int i = 0; i <= steps; ++i) {
    const auto grey = GreyAt(image, dark + (light - dark) * (static_cast<double>(i) / steps));
    if (!grey) return std::nullopt;
    greys.push_back(*grey);
  }
  const double low = greys.front(), high = greys.back();
  if (high - low < kLeastBoardContrast) return std::nullopt;
  const auto last_below = [&](double fraction) {
    const double level = low + fraction * (high - low);
    for (int i = steps; i > 0; --i) {
      const auto at = static_cast<std::size_t>(i);
      if (greys[at - 1] <= level)
        return i - (greys[at] - level) / std::max(1e-9, greys[at] - greys[at - 1]);
    }
    return 0.0;
  };
  const auto first_above = [&](double fraction) {
    const double level = low + fraction * (high - low);
    for (int i = 0; i < steps; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (greys[at + 1] >= level)
        return i + (level - greys[at]) / std::max(1e-9, greys[at + 1] - greys[at]);
    }
    return static_cast<double>(steps);
  };
  const double px_per_step = length / steps;
  return Edge{(first_above(0.9) - last_below(0.1)) * px_per_step,
              (0.5 * steps - first_above(0.5)) * px_per_step};
}

std::vector<Edge> MeasureEdges(const GrayImage& image, const CornerGrid& grid, bool first_is_dark) {
  std::vector<Edge> edges;
  const auto measure = [&](int column, int row, int next_column, int next_row) {
    Eigen::Vector2d a = GridPoint(grid, column + 0.5, row + 0.5);
    Eigen::Vector2d b = GridPoint(grid, next_column + 0.5, next_row + 0.5);
    if (((column + row) % 2 == 0) != first_is_dark) std::swap(a, b);
    if (const auto edge = MeasureEdge(image, a, b)) edges.push_back(*edge);
  };
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      if (column + 2 < grid.columns) measure(column, row, column + 1, row);
      if (row + 2 < grid.rows) measure(column, row, column, row + 1);
    }
  return edges;
}

double SaturatedFraction(const GrayImage& image, const CornerGrid& grid, bool first_is_dark) {
  int saturated = 0, asked = 0;
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      if (((column + row) % 2 == 0) == first_is_dark) continue;
      const auto grey = GreyAt(image, GridPoint(grid, column + 0.5, row + 0.5));
      if (!grey) continue;
      ++asked;
      saturated += *grey >= kSaturated ? 1 : 0;
    }
  return asked == 0 ? 0.0 : static_cast<double>(saturated) / asked;
}

/// The grey level below which this fraction of the image lies.
double Percentile(const std::array<int, 256>& histogram, double fraction) {
  double total = 0.0;
  for (const int count : histogram) total += count;
  double below = 0.0;
  for (std::size_t level = 0; level < 256; ++level) {
    below += histogram[level];
    if (below >= fraction * total) return static_cast<double>(level);
  }
  return 255.0;
}

}  // namespace

ImageRating RateImage(const GrayImage& image, const CornerGrid& grid) {
  ImageRating rating;
  std::vector<double> spacings;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      if (column > 0) spacings.push_back((grid.At(column, row) - grid.At(column - 1, row)).norm());
      if (row > 0) spacings.push_back((grid.At(column, row) - grid.At(column, row - 1)).norm());
    }
  rating.spacing_px = UpperMedian(spacings);
  rating.coverage = HullArea(grid.pixels) / (static_cast<double>(image.width()) * image.height());
  const SquareLevels levels = MeasureLevels(image, grid);
  const bool first_is_dark = levels.Contrast() > 0.0;
  rating.dark_level = std::min(levels.first, levels.second);
  rating.light_level = std::max(levels.first, levels.second);
  rating.saturated = SaturatedFraction(image, grid, first_is_dark);
  std::vector<double> widths, spills;
  for (const Edge& edge : MeasureEdges(image, grid, first_is_dark)) {
    widths.push_back(edge.width_px);
    spills.push_back(edge.spill_px);
  }
  rating.edge_width_px = UpperMedian(widths);
  if (!spills.empty()) rating.spill_px = UpperMedian(spills);
  return rating;
}

namespace {

/// Levels of the squares whose four corners are in the view: of black ones in the middle, of white
/// ones in the margin of their marker.
void RateLevels(const GrayImage& image, const CalibrationBoard& board, const BoardView& view,
                ImageRating* rating) {
  std::map<int, Eigen::Vector2d> pixels;
  for (std::size_t i = 0; i < view.corner_ids.size(); ++i)
    pixels[view.corner_ids[i]] = view.pixels[i];
  const double margin = 0.25 * (1.0 - board.marker_per_square);
  std::vector<double> dark, light;
  for (const auto& [id, upper_left] : pixels) {
    const auto right = pixels.find(id + 1), below = pixels.find(id + board.columns),
               opposite = pixels.find(id + board.columns + 1);
    const int column = id % board.columns;
    if (column + 1 == board.columns || right == pixels.end() || below == pixels.end() ||
        opposite == pixels.end())
      continue;
    const auto measure = [&](double x, double y, std::vector<double>* greys) {
      const Eigen::Vector2d top = (1.0 - x) * upper_left + x * right->second;
      const Eigen::Vector2d bottom = (1.0 - x) * below->second + x * opposite->second;
      if (const auto grey = GreyAt(image, (1.0 - y) * top + y * bottom)) greys->push_back(*grey);
    };
    if (CalibrationBoard::IsBlack(column + 1, id / board.columns + 1)) {
      measure(0.5, 0.5, &dark);
    } else {
      for (const double m : {margin, 1.0 - margin}) {
        measure(m, 0.5, &light);
        measure(0.5, m, &light);
      }
    }
  }
  if (dark.empty() || light.empty()) return;
  rating->saturated =
      static_cast<double>(std::count_if(light.begin(), light.end(),
                                        [](double grey) { return grey >= kSaturated; })) /
      static_cast<double>(light.size());
  rating->dark_level = UpperMedian(std::move(dark));
  rating->light_level = UpperMedian(std::move(light));
}

}  // namespace

ImageRating RateView(const GrayImage& image, const CalibrationBoard& board, const BoardView& view) {
  ImageRating rating;
  rating.coverage = HullArea(view.pixels) / (static_cast<double>(image.width()) * image.height());
  std::vector<double> spacings;
  for (std::size_t i = 0; i < view.pixels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((board.Corner(view.corner_ids[i]) - board.Corner(view.corner_ids[j])).norm() <
          1.1 * board.square_m)
        spacings.push_back((view.pixels[i] - view.pixels[j]).norm());
  if (!spacings.empty()) rating.spacing_px = UpperMedian(spacings);
  if (board.kind == CalibrationBoard::Kind::kCharuco) RateLevels(image, board, view, &rating);
  return rating;
}

std::string RatingFault(const ImageRating& rating) {
  if (rating.light_level - rating.dark_level < kLeastBoardContrast)
    return fmt::format("black and white squares differ by {:.0f} grey levels of 255 only",
                       rating.light_level - rating.dark_level);
  if (rating.saturated > 0.8 && rating.dark_level > kLightestBlack)
    return fmt::format(
        "overexposed: {:.0f} % of the white squares are saturated and black ones have the grey "
        "level {:.0f} of 255",
        100.0 * rating.saturated, rating.dark_level);
  if (rating.saturated > 0.5 && rating.spill_px > kFarthestSpill * rating.spacing_px)
    return fmt::format("overexposed: white squares spill {:.1f} px into black ones",
                       rating.spill_px);
  if (rating.edge_width_px > kWidestEdge * rating.spacing_px)
    return fmt::format("blurred: edges are {:.1f} px wide where squares have {:.0f} px",
                       rating.edge_width_px, rating.spacing_px);
  return {};
}

std::string ImageFault(const GrayImage& image) {
  std::array<int, 256> histogram{};
  for (const std::uint8_t grey : image.values()) ++histogram[grey];
  double saturated = 0.0;
  for (std::size_t level = static_cast<std::size_t>(kSaturated); level < 256; ++level)
    saturated += histogram[level];
  saturated /= static_cast<double>(image.size());
  if (saturated > 0.4)
    return fmt::format("overexposed: {:.0f} % of the image is saturated", 100.0 * saturated);
  const double dark = Percentile(histogram, 0.02), light = Percentile(histogram, 0.98);
  if (light < 40.0)
    return fmt::format("underexposed: 98 % of the image lies below the grey level {:.0f} of 255",
                       light);
  if (light - dark < 2.0 * kLeastBoardContrast) return "the image has no contrast";
  // Sharp edges step by most of the contrast within two or three pixels.
  std::vector<double> steps;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 2; x + 2 < image.width(); x += 3)
      steps.push_back(std::abs(static_cast<double>(image(x + 2, y)) - image(x - 2, y)));
  if (steps.empty()) return "the image is too small";
  const auto rank = static_cast<std::size_t>(0.998 * static_cast<double>(steps.size() - 1));
  const double strong = ValueAtRank(std::move(steps), rank);
  const double width_px = 0.8 * (light - dark) * 4.0 / std::max(1.0, strong);
  if (width_px > 8.0)
    return fmt::format("blurred: even the sharpest edges are about {:.0f} px wide", width_px);
  return {};
}

}  // namespace foresight
