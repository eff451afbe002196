#include "core/calibration/checkerboard_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/calibration/grid_checks.h"
#include "core/calibration/grid_growth.h"
#include "core/calibration/refine_corners.h"
#include "core/calibration/saddle_grids.h"

namespace foresight {
namespace {

/// Grey levels that a median of 3 x 3 changes a pixel by, on average, in a noisy image.
constexpr double kNoisy = 1.2;

cv::Mat Wrap(const GrayImage& image) {
  return {image.height(), image.width(), CV_8UC1,
          const_cast<std::uint8_t*>(image.data())};  // never written
}

CornerGrid GridOf(const std::vector<cv::Point2f>& points, int columns, int rows, double scale) {
  CornerGrid grid{columns, rows, {}};
  // Pixel centres: a resized image has its pixel (0, 0) at the middle of the block it came from.
  for (const cv::Point2f& p : points)
    grid.pixels.emplace_back((p.x + 0.5) / scale - 0.5, (p.y + 0.5) / scale - 0.5);
  return grid;
}

cv::Mat Scaled(const GrayImage& image, double scale) {
  if (scale == 1.0) return Wrap(image);
  cv::Mat scaled;
  cv::resize(Wrap(image), scaled, {}, scale, scale, scale < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
  return scaled;
}

std::optional<CornerGrid> FindWithSectors(const GrayImage& image, int columns, int rows,
                                          double scale, int flags) {
  std::vector<cv::Point2f> points;
  if (!cv::findChessboardCornersSB(Scaled(image, scale), {columns, rows}, points, flags) ||
      points.size() != static_cast<std::size_t>(columns * rows))
    return std::nullopt;
  return GridOf(points, columns, rows, scale);
}

/// The image without most of its noise, and how much that was.
struct SmoothImage {
  cv::Mat pixels;
  double noise = 0.0;  ///< mean change of a pixel, grey levels
};

SmoothImage Smoothed(const GrayImage& image) {
  SmoothImage smooth;
  cv::medianBlur(Wrap(image), smooth.pixels, 3);
  cv::Mat change;
  cv::absdiff(Wrap(image), smooth.pixels, change);
  smooth.noise = cv::mean(change)[0];
  if (smooth.noise > kNoisy) cv::medianBlur(Wrap(image), smooth.pixels, 5);
  return smooth;
}

std::optional<CornerGrid> FindWithQuads(const SmoothImage& image, int columns, int rows,
                                        double scale) {
  // Noise makes thousands of tiny quadrangles, which this detector joins one by one for ten seconds
  // and more. A median takes most of them and keeps the corners of thin squares.
  if (scale > 1.0 && image.noise > kNoisy) return std::nullopt;
  cv::Mat scaled = image.pixels;
  if (scale != 1.0)
    cv::resize(image.pixels, scaled, {}, scale, scale,
               scale < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
  std::vector<cv::Point2f> points;
  if (!cv::findChessboardCorners(scaled, {columns, rows}, points,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return std::nullopt;
  return GridOf(points, columns, rows, scale);
}

/// The candidate refined, if it is a board of this size and no part of a larger one.
std::optional<CornerGrid> Accepted(const GrayImage& image, const std::optional<CornerGrid>& found,
                                   int columns, int rows) {
  if (!found) return std::nullopt;
  auto grid = Arranged(*found, columns, rows);
  if (!grid) return std::nullopt;
  RefineCorners(image, *grid);
  if (!IsRegular(image, *grid) || !Ends(image, *grid, OutsideImage::kIsAnEnd)) return std::nullopt;
  return grid;
}

constexpr int kThorough = cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY;

/// The largest of the grids, and whether it is a board that ends.
void LookForAnother(const GrayImage& image, const std::vector<CornerGrid>& grids,
                    CheckerboardSearch* search) {
  const auto largest = std::max_element(
      grids.begin(), grids.end(),
      [](const CornerGrid& a, const CornerGrid& b) { return a.pixels.size() < b.pixels.size(); });
  if (largest == grids.end()) return;
  search->other = *largest;
  search->other_is_whole =
      largest->columns >= 4 && largest->rows >= 4 && Ends(image, *largest, OutsideImage::kIsNoEnd);
}

/// With OpenCV's detectors, which take longer.
std::optional<CornerGrid> FindThoroughly(const GrayImage& image, int columns, int rows) {
  std::optional<CornerGrid> grid;
  const auto found = [&](const std::optional<CornerGrid>& candidate) {
    grid = Accepted(image, candidate, columns, rows);
    return grid.has_value();
  };
  const int side = std::max(image.width(), image.height());
  if (side > 700 && found(FindWithSectors(image, columns, rows, 0.5, kThorough))) return grid;
  if (found(FindWithSectors(image, columns, rows, 1.0, kThorough))) return grid;
  const SmoothImage smooth = Smoothed(image);
  if (found(FindWithQuads(smooth, columns, rows, 1.0))) return grid;
  if (found(FindWithQuads(smooth, columns, rows, 0.5))) return grid;
  if (found(FindWithSectors(image, columns, rows, 1.0, kThorough | cv::CALIB_CB_NORMALIZE_IMAGE)))
    return grid;
  if (side > 1400) {
    found(FindWithSectors(image, columns, rows, 0.25, kThorough));
    return grid;
  }
  if (found(FindWithQuads(smooth, columns, rows, 2.0))) return grid;
  found(FindWithSectors(image, columns, rows, 2.0, kThorough));
  return grid;
}

}  // namespace

std::vector<CornerGrid> FindGrids(const GrayImage& image) {
  std::vector<CornerGrid> grids;
  for (const CornerGrid& rough : FindSaddleGrids(image)) {
    auto grid = Arranged(rough, rough.columns, rough.rows);
    RefineCorners(image, *grid);
    CornerGrid seen = Trimmed(image, std::move(*grid));
    if (seen.columns < 3 || seen.rows < 3 || !IsRegular(image, seen)) continue;
    CornerGrid grown = Grown(image, std::move(seen));
    RefineCorners(image, grown);
    if (IsRegular(image, grown)) grids.push_back(std::move(grown));
  }
  return grids;
}

CheckerboardSearch FindCheckerboard(const GrayImage& image, const std::vector<CornerGrid>& grids,
                                    int columns, int rows, SearchEffort effort) {
  CheckerboardSearch search;
  for (const CornerGrid& grid : grids) {
    search.grid = Accepted(image, grid, columns, rows);
    if (search.grid) return search;
  }
  LookForAnother(image, grids, &search);
  if (effort == SearchEffort::kQuick) return search;
  // A larger board is there: further attempts could only find a part of it.
  const bool fits =
      search.other &&
      std::max(search.other->columns, search.other->rows) <= std::max(columns, rows) &&
      std::min(search.other->columns, search.other->rows) <= std::min(columns, rows);
  if (search.other_is_whole && !fits) return search;
  search.grid = FindThoroughly(image, columns, rows);
  return search;
}

}  // namespace foresight
