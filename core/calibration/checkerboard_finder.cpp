#include "core/calibration/checkerboard_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/calibration/refine_corners.h"

namespace foresight {
namespace {

/// Fraction of the board's contrast that squares around a corner must have.
constexpr double kLocalContrast = 0.35;
/// Grey levels below which a pattern is noise.
constexpr double kLeastContrast = 8.0;
/// Fraction of the corners that must pass. Glare and shadows hide some.
constexpr double kCornersThatPass = 0.9;
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

std::optional<CornerGrid> FindPart(const GrayImage& image, double scale, int flags) {
  std::vector<cv::Point2f> points;
  cv::Mat meta;
  if (!cv::findChessboardCornersSB(Scaled(image, scale), {3, 3}, points,
                                   flags | cv::CALIB_CB_LARGER, meta) ||
      meta.total() != points.size())
    return std::nullopt;
  return GridOf(points, meta.cols, meta.rows, scale);
}

double SignOf(int column, int row) {
  return (column + row) % 2 == 0 ? 1.0 : -1.0;
}

/// Grey values of the four squares around a corner: upper left, upper right, lower right, lower
/// left. nullopt where one lies outside of the image.
std::optional<std::array<double, 4>> SquaresAround(const GrayImage& image, const CornerGrid& grid,
                                                   int column, int row) {
  constexpr double kReach = 0.4;  // of a square: clear of edges, blurred ones too
  constexpr std::array<std::array<double, 2>, 4> kOffsets = {
      {{-kReach, -kReach}, {kReach, -kReach}, {kReach, kReach}, {-kReach, kReach}}};
  std::array<double, 4> greys{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto grey = GreyAt(image, GridPoint(grid, column + kOffsets[i][0], row + kOffsets[i][1]));
    if (!grey) return std::nullopt;
    greys[i] = *grey;
  }
  return greys;
}

bool IsRegular(const GrayImage& image, const CornerGrid& grid) {
  const double contrast = MeasureLevels(image, grid).Contrast();
  if (std::abs(contrast) < kLeastContrast) return false;
  int passed = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      passed += IsCorner(image, grid, column, row, contrast) ? 1 : 0;
  return passed >= kCornersThatPass * grid.columns * grid.rows;
}

/// One side of a grid.
struct Side {
  bool above_or_below = false;  ///< else left or right
  bool at_end = false;          ///< below or right
};
constexpr std::array<Side, 4> kSides = {
    {{false, false}, {false, true}, {true, false}, {true, true}}};

/// How the next corners are guessed from the last three of each line: on a parabola, or each step
/// shorter than the one before by the same factor, as towards the rim of a fisheye image.
enum class Guess { kParabola, kSameRatio };

/// A grid with one more row or column, and how many of its corners are there.
struct Extension {
  CornerGrid grid;
  int asked = 0;   ///< corners of the new line whose squares lie in the image
  int passed = 0;  ///< those that are corners
  int hidden = 0;  ///< corners that would lie outside of the image
};

Eigen::Vector2d GuessBeyond(const std::array<Eigen::Vector2d, 3>& last, Guess guess) {
  if (guess == Guess::kParabola) return 3.0 * last[0] - 3.0 * last[1] + last[2];
  const Eigen::Vector2d step = last[0] - last[1];
  const double ratio = step.norm() / std::max(1e-9, (last[1] - last[2]).norm());
  return last[0] + std::clamp(ratio, 0.4, 1.6) * step;
}

Extension Extended(const GrayImage& image, const CornerGrid& grid, const Side& side, Guess guess) {
  const double contrast = MeasureLevels(image, grid).Contrast();
  const bool rows = side.above_or_below;
  const int along = rows ? grid.columns : grid.rows;
  const int across = rows ? grid.rows : grid.columns;
  const int shift_x = !rows && !side.at_end ? 1 : 0, shift_y = rows && !side.at_end ? 1 : 0;
  Extension extension;
  CornerGrid& wider = extension.grid;
  wider.columns = grid.columns + (rows ? 0 : 1);
  wider.rows = grid.rows + (rows ? 1 : 0);
  wider.pixels.resize(static_cast<std::size_t>(wider.columns * wider.rows));
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      wider.At(column + shift_x, row + shift_y) = grid.At(column, row);
  const auto place = [&](int i, int depth) {  // depth 0 is the grid's outer line
    const int j = side.at_end ? across - 1 - depth : depth;
    return rows ? std::pair(i, j) : std::pair(j, i);
  };
  for (int i = 0; i < along; ++i) {
    std::array<Eigen::Vector2d, 3> last;
    for (int depth = 0; depth < 3; ++depth) {
      const auto [column, row] = place(i, depth);
      last[static_cast<std::size_t>(depth)] = grid.At(column, row);
    }
    const Eigen::Vector2d beyond = GuessBeyond(last, guess);
    extension.hidden += GreyAt(image, beyond) ? 0 : 1;
    const double reach = 0.35 * (beyond - last[0]).norm();
    const auto corner = RefineCorner(image, beyond, reach);
    const auto [column, row] = place(i, -1);
    wider.At(column + shift_x, row + shift_y) =
        corner && (*corner - beyond).norm() < reach ? *corner : beyond;
  }
  for (int i = 0; i < along; ++i) {
    const auto [column, row] = place(i, -1);
    if (!SquaresAround(image, wider, column + shift_x, row + shift_y)) continue;
    ++extension.asked;
    extension.passed += IsCorner(image, wider, column + shift_x, row + shift_y,
                                 shift_x + shift_y > 0 ? -contrast : contrast)
                            ? 1
                            : 0;
  }
  return extension;
}

/// Whether the board goes on beyond none of the grid's sides; what lies outside of the image is not
/// known, and counts as an end or not.
enum class OutsideImage { kIsAnEnd, kIsNoEnd };
bool Ends(const GrayImage& image, const CornerGrid& grid, OutsideImage outside) {
  for (const Side& side : kSides)
    for (const Guess guess : {Guess::kParabola, Guess::kSameRatio}) {
      const Extension more = Extended(image, grid, side, guess);
      const int along = side.above_or_below ? grid.columns : grid.rows;
      if (2 * more.hidden > along && outside == OutsideImage::kIsNoEnd) return false;
      if (more.asked >= 3 && more.passed >= 0.6 * more.asked) return false;
    }
  return true;
}

/// The grid with one more row or column on one side, if its corners are there.
std::optional<CornerGrid> Wider(const GrayImage& image, const CornerGrid& grid, const Side& side) {
  const int along = side.above_or_below ? grid.columns : grid.rows;
  for (const Guess guess : {Guess::kParabola, Guess::kSameRatio})
    if (Extension more = Extended(image, grid, side, guess);
        more.passed >= kCornersThatPass * along)
      return std::move(more.grid);
  return std::nullopt;
}

CornerGrid Grown(const GrayImage& image, CornerGrid grid, int most_across) {
  bool growing = true;
  while (growing) {
    growing = false;
    for (const Side& side : kSides) {
      if ((side.above_or_below ? grid.rows : grid.columns) >= most_across) continue;
      if (auto wider = Wider(image, grid, side)) {
        grid = std::move(*wider);
        growing = true;
      }
    }
  }
  return grid;
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
constexpr int kMostAcross = 61;

std::optional<CornerGrid> GrownFromParts(const GrayImage& image) {
  std::optional<CornerGrid> largest;
  for (const double scale : {1.0, 0.5})
    for (const int flags : {0, static_cast<int>(cv::CALIB_CB_EXHAUSTIVE),
                            cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_NORMALIZE_IMAGE}) {
      auto part = FindPart(image, scale, flags);
      if (!part) continue;
      part = Arranged(*part, part->columns, part->rows);
      RefineCorners(image, *part);
      if (!IsRegular(image, *part)) continue;
      CornerGrid grown = Grown(image, *part, kMostAcross);
      if (!largest || grown.pixels.size() > largest->pixels.size()) largest = std::move(grown);
    }
  return largest;
}

}  // namespace

bool IsCorner(const GrayImage& image, const CornerGrid& grid, int column, int row,
              double contrast) {
  const auto greys = SquaresAround(image, grid, column, row);
  if (!greys) return false;
  const auto& [upper_left, upper_right, lower_right, lower_left] = *greys;
  // Of the colour of the print's first square for an even corner: the upper left and lower right.
  const double sign = SignOf(column, row) * (contrast > 0.0 ? 1.0 : -1.0);
  const double darkest_light =
      sign > 0.0 ? std::min(upper_right, lower_left) : std::min(upper_left, lower_right);
  const double lightest_dark =
      sign > 0.0 ? std::max(upper_left, lower_right) : std::max(upper_right, lower_left);
  return darkest_light - lightest_dark > kLocalContrast * std::abs(contrast);
}

CheckerboardSearch FindCheckerboard(const GrayImage& image, int columns, int rows,
                                    SearchEffort effort) {
  CheckerboardSearch search;
  const int side = std::max(image.width(), image.height());
  const auto found = [&](const std::optional<CornerGrid>& candidate) {
    search.grid = Accepted(image, candidate, columns, rows);
    return search.grid.has_value();
  };
  // Cheap first: most images are found in a tenth of a second.
  if (side > 700 && found(FindWithSectors(image, columns, rows, 0.5, kThorough))) return search;
  if (found(FindWithSectors(image, columns, rows, 1.0, kThorough))) return search;
  if (effort == SearchEffort::kQuick) return search;
  search.other = GrownFromParts(image);
  if (search.other) {
    if (found(search.other)) return search;
    search.other_is_whole = search.other->columns >= 4 && search.other->rows >= 4 &&
                            Ends(image, *search.other, OutsideImage::kIsNoEnd);
    // A larger board is there: further attempts could only find a part of it.
    const bool fits =
        std::max(search.other->columns, search.other->rows) <= std::max(columns, rows) &&
        std::min(search.other->columns, search.other->rows) <= std::min(columns, rows);
    if (search.other_is_whole && !fits) return search;
  }
  if (effort == SearchEffort::kLive) return search;
  const SmoothImage smooth = Smoothed(image);
  if (found(FindWithQuads(smooth, columns, rows, 1.0))) return search;
  if (found(FindWithQuads(smooth, columns, rows, 0.5))) return search;
  if (found(FindWithSectors(image, columns, rows, 1.0, kThorough | cv::CALIB_CB_NORMALIZE_IMAGE)))
    return search;
  if (side > 1400) {
    found(FindWithSectors(image, columns, rows, 0.25, kThorough));
    return search;
  }
  if (found(FindWithQuads(smooth, columns, rows, 2.0))) return search;
  found(FindWithSectors(image, columns, rows, 2.0, kThorough));
  return search;
}

}  // namespace foresight
