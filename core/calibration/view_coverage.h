#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/calibration/intrinsics.h"

namespace foresight {

/// Where in the image a set of views has corners, and how their boards were held.
struct ViewCoverage {
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;
  static constexpr int kRings = 5;
  /// Limits between the bins of tilt, deg, and of distance relative to the nearest board.
  static constexpr std::array<double, 3> kTiltLimits_deg = {10.0, 20.0, 35.0};
  static constexpr std::array<double, 2> kDistanceLimits = {1.3, 2.0};
  static constexpr double kTilted_deg = 20.0;

  int images = 0;
  std::array<int, kColumns* kRows> cells = {};  ///< corners in each cell, row by row
  /// Corners by distance from the image's middle, in fifths of half the diagonal.
  std::array<int, kRings> rings = {};

  /// How many of the images have a known pose; all below is of those.
  int posed = 0;
  std::array<int, 4> tilts = {};      ///< images by the angle between normal and line of sight
  std::array<int, 3> distances = {};  ///< images by distance over that of the nearest
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  /// Boards tilted by kTilted_deg and more, by the edge that is turned away from the camera.
  enum Away { kLeft, kRight, kTop, kBottom };
  std::array<int, 4> away = {};

  int Cell(int column, int row) const {
    return cells[static_cast<std::size_t>(row * kColumns + column)];
  }
  /// The fraction of the cells that have a corner.
  double CoveredFraction() const;
  int Tilted() const { return tilts[2] + tilts[3]; }
};

/// @param errors poses of the images under one camera; empty where none was found
ViewCoverage MeasureCoverage(const CalibrationBoard& board,
                             const std::vector<IntrinsicsImage>& images, int width, int height,
                             const std::vector<ImageErrors>& errors);

/// Which image would help most, after "next: ": "the board at the left edge, tilted by over 20 deg
/// with its top edge away". Empty where no further image is needed.
std::string NextImage(const ViewCoverage& coverage, int min_images);

}  // namespace foresight
