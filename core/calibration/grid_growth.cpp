#include "core/calibration/grid_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/calibration/grid_checks.h"
#include "core/calibration/grid_edges.h"
#include "core/calibration/refine_corners.h"

namespace foresight {
namespace {

/// One side of a grid.
struct Side {
  bool above_or_below = false;  ///< else left or right
  bool at_end = false;          ///< below or right
};
constexpr std::array<Side, 4> kSides = {
    {{false, false}, {false, true}, {true, false}, {true, true}}};

/// Of the step to a guessed corner: the guess is as good as that.
constexpr double kGuessedWithin = 0.25;

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
    const double reach = kGuessedWithin * (beyond - last[0]).norm();
    const auto corner = RefineCorner(image, beyond, reach);
    const auto [column, row] = place(i, -1);
    wider.At(column + shift_x, row + shift_y) =
        corner && (*corner - beyond).norm() < reach ? *corner : beyond;
  }
  for (int i = 0; i < along; ++i) {
    const auto [column, row] = place(i, -1);
    const auto [last_column, last_row] = place(i, 0);
    if (!SquaresAreSeen(image, wider, column + shift_x, row + shift_y)) continue;
    ++extension.asked;
    const double turned = shift_x + shift_y > 0 ? -contrast : contrast;
    // At the print's outer edge, the squares of another board may alternate farther away.
    const bool is_corner =
        IsCorner(image, wider, column + shift_x, row + shift_y, turned) &&
        IsCorner(image, wider, column + shift_x, row + shift_y, turned, kNearReach) &&
        IsEdge(image, grid.At(last_column, last_row), wider.At(column + shift_x, row + shift_y),
               kEdgeContrast * std::abs(contrast));
    extension.passed += is_corner ? 1 : 0;
  }
  return extension;
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

}  // namespace

bool Ends(const GrayImage& image, const CornerGrid& grid, OutsideImage outside) {
  for (const Side& side : kSides)
    for (const Guess guess : {Guess::kParabola, Guess::kSameRatio}) {
      const Extension more = Extended(image, grid, side, guess);
      const int along = side.above_or_below ? grid.columns : grid.rows;
      if (2 * more.hidden > along && outside == OutsideImage::kIsNoEnd) return false;
      // Below what growth asks for (kCornersThatPass): one more row that is covered in part is one.
      if (more.asked >= 3 && more.passed >= 0.6 * more.asked) return false;
    }
  return true;
}

bool HasMargin(const GrayImage& image, const CornerGrid& grid) {
  // Of a square, beyond the outer corners: inside of the outer square, and on the margin.
  constexpr double kInside = 0.9, kBeyond = 1.1;
  // Of the contrast, how much darker and lighter than the white beside it the margin may be: thin
  // ones are blurred, and what is lighter is no paper.
  constexpr double kDarker = 0.5, kLighter = 0.15;
  const SquareLevels levels = MeasureLevels(image, grid);
  const double middle = 0.5 * (levels.first + levels.second);
  const double contrast = std::abs(levels.Contrast());
  for (const Side& side : kSides) {
    const int along = side.above_or_below ? grid.columns : grid.rows;
    const int across = side.above_or_below ? grid.rows : grid.columns;
    const auto grey = [&](double i, double depth) {
      const double j = side.at_end ? across - 1 + depth : -depth;
      return GreyAt(image, side.above_or_below ? GridPoint(grid, i, j) : GridPoint(grid, j, i));
    };
    int passed = 0;
    for (int square = 0; square + 1 < along; ++square) {
      const auto outer = grey(square + 0.5, 0.5), inside = grey(square + 0.5, kInside),
                 beyond = grey(square + 0.5, kBeyond),
                 next = grey(square + (square + 2 < along ? 1.5 : -0.5), 0.5);
      if (!outer || !inside || !beyond || !next) continue;
      const double white = std::max(*outer, *next);
      if (*beyond < white - kDarker * contrast || *beyond > white + kLighter * contrast) continue;
      passed += (*outer < middle) == (*inside < middle) ? 1 : 0;
    }
    if (passed < along - 1) return false;
  }
  return true;
}

CornerGrid Trimmed(const GrayImage& image, CornerGrid grid) {
  while (grid.columns >= 3 && grid.rows >= 3 && !IsRegular(image, grid)) {
    const double contrast = MeasureLevels(image, grid).Contrast();
    double least = 1.0;
    Side worst;
    for (const Side& side : kSides) {
      const int along = side.above_or_below ? grid.columns : grid.rows;
      const int last = (side.above_or_below ? grid.rows : grid.columns) - 1;
      int passed = 0;
      for (int i = 0; i < along; ++i) {
        const int j = side.at_end ? last : 0;
        passed += IsCorner(image, grid, side.above_or_below ? i : j, side.above_or_below ? j : i,
                           contrast)
                      ? 1
                      : 0;
      }
      if (passed >= least * along) continue;
      least = static_cast<double>(passed) / along;
      worst = side;
    }
    if (least >= kCornersThatPass) break;  // the fault is inside
    const bool rows = worst.above_or_below;
    CornerGrid less{grid.columns - (rows ? 0 : 1), grid.rows - (rows ? 1 : 0), {}};
    const int shift = worst.at_end ? 0 : 1;
    for (int row = 0; row < less.rows; ++row)
      for (int column = 0; column < less.columns; ++column)
        less.pixels.push_back(grid.At(column + (rows ? 0 : shift), row + (rows ? shift : 0)));
    grid = std::move(less);
  }
  return grid;
}

CornerGrid Grown(const GrayImage& image, CornerGrid grid) {
  constexpr int kMostAcross = 61;
  bool growing = true;
  while (growing) {
    growing = false;
    for (const Side& side : kSides) {
      if ((side.above_or_below ? grid.rows : grid.columns) >= kMostAcross) continue;
      if (auto wider = Wider(image, grid, side)) {
        grid = std::move(*wider);
        growing = true;
      }
    }
  }
  return grid;
}

}  // namespace foresight
