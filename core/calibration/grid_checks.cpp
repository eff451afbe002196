#include "core/calibration/grid_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/calibration/grid_edges.h"

namespace foresight {
namespace {

/// Fraction of the board's contrast that squares around a corner must have.
constexpr double kLocalContrast = 0.35;
/// Grey levels below which a pattern is noise.
constexpr double kLeastContrast = 8.0;

double SignOf(int column, int row) {
  return (column + row) % 2 == 0 ? 1.0 : -1.0;
}

/// Grey values of the four squares around a corner: upper left, upper right, lower right, lower
/// left. nullopt where one lies outside of the image.
std::optional<std::array<double, 4>> SquaresAround(const GrayImage& image, const CornerGrid& grid,
                                                   int column, int row, double reach) {
  const std::array<std::array<double, 2>, 4> offsets = {
      {{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}}};
  std::array<double, 4> greys{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto grey = GreyAt(image, GridPoint(grid, column + offsets[i][0], row + offsets[i][1]));
    if (!grey) return std::nullopt;
    greys[i] = *grey;
  }
  return greys;
}

bool CornersPass(const GrayImage& image, const CornerGrid& grid) {
  const double contrast = MeasureLevels(image, grid).Contrast();
  int passed = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      passed += IsCorner(image, grid, column, row, contrast) ? 1 : 0;
  return passed >= kCornersThatPass * grid.columns * grid.rows;
}

/// Whether most of the edges between each two neighbouring rows and columns are there, blurred ones
/// too.
bool HangsTogether(const GrayImage& image, const CornerGrid& grid, double contrast) {
  constexpr double kBlurredEdgeContrast = 0.1;
  const auto joined = [&](int count, const auto& from, const auto& to) {
    int edges = 0;
    for (int i = 0; i < count; ++i)
      edges += IsEdge(image, from(i), to(i), kBlurredEdgeContrast * contrast) ? 1 : 0;
    return 2 * edges >= count;
  };
  for (int column = 0; column + 1 < grid.columns; ++column)
    if (!joined(
            grid.rows, [&](int row) { return grid.At(column, row); },
            [&](int row) { return grid.At(column + 1, row); }))
      return false;
  for (int row = 0; row + 1 < grid.rows; ++row)
    if (!joined(
            grid.columns, [&](int column) { return grid.At(column, row); },
            [&](int column) { return grid.At(column, row + 1); }))
      return false;
  return true;
}

}  // namespace

bool IsCorner(const GrayImage& image, const CornerGrid& grid, int column, int row, double contrast,
              double reach) {
  const auto greys = SquaresAround(image, grid, column, row, reach);
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

bool SquaresAreSeen(const GrayImage& image, const CornerGrid& grid, int column, int row) {
  return SquaresAround(image, grid, column, row, kReach).has_value();
}

std::vector<int> UncertainCorners(const GrayImage& image, const CornerGrid& grid) {
  const double contrast = MeasureLevels(image, grid).Contrast();
  std::vector<int> covered, uncertain;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int corner = row * grid.columns + column;
      const bool is_covered = !IsCorner(image, grid, column, row, contrast);
      if (is_covered) covered.push_back(corner);
      if (is_covered || !IsCorner(image, grid, column, row, contrast, kNearReach))
        uncertain.push_back(corner);
    }
  // Many are uncertain where the whole image is blurred.
  const double most = (1.0 - kCornersThatPass) * grid.columns * grid.rows;
  return static_cast<double>(uncertain.size()) > most ? covered : uncertain;
}

bool IsRegular(const GrayImage& image, const CornerGrid& grid) {
  const double contrast = std::abs(MeasureLevels(image, grid).Contrast());
  return contrast >= kLeastContrast && CornersPass(image, grid) &&
         HangsTogether(image, grid, contrast);
}

}  // namespace foresight
