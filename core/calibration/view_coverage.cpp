#include "core/calibration/view_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// As many images as the literature takes, and after which another one adds little.
constexpr int kGoodNumber = 15;
/// A region with a smaller fraction of cells with corners is asked for.
constexpr double kCovered = 0.5;
/// A board held straight tells the lens from the distance badly: a third of the images is tilted.
constexpr int kTiltedOneOf = 3;

struct Region {
  const char* name;
  int left, right, top, bottom;  ///< cells from left to right - 1, top to bottom - 1
};

constexpr int kC = ViewCoverage::kColumns, kR = ViewCoverage::kRows;
/// Corners of the image come first: of regions that are equally empty the first is asked for.
constexpr std::array<Region, 9> kRegions = {{{"in the upper left corner", 0, 2, 0, 2},
                                             {"in the upper right corner", kC - 2, kC, 0, 2},
                                             {"in the lower left corner", 0, 2, kR - 2, kR},
                                             {"in the lower right corner", kC - 2, kC, kR - 2, kR},
                                             {"at the left edge", 0, 2, 0, kR},
                                             {"at the right edge", kC - 2, kC, 0, kR},
                                             {"at the top edge", 0, kC, 0, 2},
                                             {"at the bottom edge", 0, kC, kR - 2, kR},
                                             {"in the middle", 2, kC - 2, 2, kR - 2}}};

double CoveredFractionOf(const ViewCoverage& coverage, const Region& region) {
  int covered = 0;
  for (int row = region.top; row < region.bottom; ++row)
    for (int column = region.left; column < region.right; ++column)
      covered += coverage.Cell(column, row) > 0 ? 1 : 0;
  return static_cast<double>(covered) /
         ((region.right - region.left) * (region.bottom - region.top));
}

/// The region that most is missing from: a whole edge before a corner of it.
const Region* EmptiestRegion(const ViewCoverage& coverage) {
  const Region* emptiest = nullptr;
  double most_missing = 0.0;
  for (const Region& region : kRegions) {
    const double covered = CoveredFractionOf(coverage, region);
    const int cells = (region.right - region.left) * (region.bottom - region.top);
    const double missing = (1.0 - covered) * cells;
    if (covered >= kCovered || missing <= most_missing) continue;
    emptiest = &region;
    most_missing = missing;
  }
  return emptiest;
}

std::string TiltWanted(const ViewCoverage& coverage) {
  if (coverage.posed == 0) return ", tilted by over 20 deg";
  const auto least = std::min_element(coverage.away.begin(), coverage.away.end());
  constexpr std::array<const char*, 4> kEdges = {"left", "right", "top", "bottom"};
  return fmt::format(", tilted by over 20 deg with its {} edge away",
                     kEdges[static_cast<std::size_t>(least - coverage.away.begin())]);
}

template <std::size_t n>
std::size_t BinOf(double value, const std::array<double, n>& limits) {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), value) -
                                  limits.begin());
}

void CountCorners(const BoardView& view, int width, int height, ViewCoverage& coverage) {
  const Eigen::Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));
  for (const Eigen::Vector2d& pixel : view.pixels) {
    const int column = std::clamp(static_cast<int>((pixel.x() + 0.5) / width * kC), 0, kC - 1);
    const int row = std::clamp(static_cast<int>((pixel.y() + 0.5) / height * kR), 0, kR - 1);
    ++coverage.cells[static_cast<std::size_t>(row * kC + column)];
    const double radius = (pixel - middle).norm() / (0.5 * std::hypot(width, height));
    const int ring =
        std::clamp(static_cast<int>(radius * ViewCoverage::kRings), 0, ViewCoverage::kRings - 1);
    ++coverage.rings[static_cast<std::size_t>(ring)];
  }
}

void CountPose(const CameraFromPattern& pose, const Eigen::Vector3d& middle,
               ViewCoverage& coverage) {
  const Eigen::Vector3d sight = (pose * middle).normalized();
  const Eigen::Vector3d normal = pose.Rotate(Eigen::Vector3d::UnitZ());
  const double tilt_deg = DegreesFromRadians(std::acos(std::min(1.0, std::abs(normal.dot(sight)))));
  ++coverage.tilts[BinOf(tilt_deg, ViewCoverage::kTiltLimits_deg)];
  if (tilt_deg < ViewCoverage::kTilted_deg) return;
  // The normal points away from the camera; the edge towards which it leans is the near one.
  const Eigen::Vector3d lean = normal - normal.dot(sight) * sight;
  const ViewCoverage::Away away =
      std::abs(lean.x()) > std::abs(lean.y())
          ? (lean.x() > 0.0 ? ViewCoverage::kLeft : ViewCoverage::kRight)
          : (lean.y() > 0.0 ? ViewCoverage::kTop : ViewCoverage::kBottom);
  ++coverage.away[away];
}

}  // namespace

double ViewCoverage::CoveredFraction() const {
  const auto covered = std::count_if(cells.begin(), cells.end(), [](int n) { return n > 0; });
  return static_cast<double>(covered) / static_cast<double>(cells.size());
}

ViewCoverage MeasureCoverage(const CalibrationBoard& board,
                             const std::vector<IntrinsicsImage>& images, int width, int height,
                             const std::vector<ImageErrors>& errors) {
  ViewCoverage coverage;
  coverage.images = static_cast<int>(images.size());
  for (const IntrinsicsImage& image : images) CountCorners(image.view, width, height, coverage);
  if (errors.empty()) return coverage;
  const Eigen::Vector3d middle = 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
  const auto distance = [&](const ImageErrors& image) {
    return (image.camera_from_pattern * middle).norm();
  };
  coverage.posed = static_cast<int>(errors.size());
  coverage.nearest_m = coverage.farthest_m = distance(errors.front());
  for (const ImageErrors& image : errors) {
    coverage.nearest_m = std::min(coverage.nearest_m, distance(image));
    coverage.farthest_m = std::max(coverage.farthest_m, distance(image));
    CountPose(image.camera_from_pattern, middle, coverage);
  }
  for (const ImageErrors& image : errors)
    ++coverage
          .distances[BinOf(distance(image) / coverage.nearest_m, ViewCoverage::kDistanceLimits)];
  return coverage;
}

std::string NextImage(const ViewCoverage& coverage, int min_images) {
  if (coverage.images == 0) return "the board in the middle, so near that it fills half the image";
  const bool wants_tilt = coverage.posed == 0 || kTiltedOneOf * coverage.Tilted() < coverage.posed;
  const std::string tilt = wants_tilt ? TiltWanted(coverage) : "";
  if (const Region* region = EmptiestRegion(coverage))
    return fmt::format("the board {}{}", region->name, tilt);
  if (wants_tilt) return "the board in the middle" + tilt;
  if (coverage.posed > 0 &&
      coverage.farthest_m < ViewCoverage::kDistanceLimits[0] * coverage.nearest_m)
    return fmt::format("the board nearer than {:.1f} m or farther than {:.1f} m",
                       0.7 * coverage.nearest_m, 1.5 * coverage.farthest_m);
  if (coverage.images < std::max(min_images, kGoodNumber))
    return "the board anywhere, turned in a new direction";
  return {};
}

}  // namespace foresight
