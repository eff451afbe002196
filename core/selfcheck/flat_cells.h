#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/registration/register_scan.h"

namespace foresight {

/// A flat patch of a scan: some neighbouring beams of some neighbouring lines that were taken while
/// the head moved one way.
struct FlatCell {
  Eigen::Vector3d center;     ///< mean of its points, in base
  Eigen::Vector3d normal;     ///< of length 1, towards the lidar
  Eigen::Vector3d in_head;    ///< the centre as the plate has it, from the lidar's origin
  Eigen::Vector3d direction;  ///< of its middle beam, in head
  double plate_rad = 0.0;
  double speed_rad_s = 0.0;  ///< of the plate; negative = downwards
  double rms_m = 0.0;        ///< of the points about their plane
  int points = 0;
};

struct FlatCellOptions {
  int beams = 12;            ///< 3 deg of the usual lidar
  double lines_rad = 0.035;  ///< lines of so much of the motor's turn, 2 deg; at least 3 lines
  double least_filled = 0.7;
  double most_rms_m = 0.030;        ///< rougher patches are not flat
  double least_incidence = 0.17;    ///< cosine at the normal: grazing beams measure little
  double least_speed_rad_s = 0.01;  ///< of lines that count as moving
};

/// The scan's flat patches, from all lines that were taken while the head moved. O(points).
/// @param cloud RegisterScan's, of this scan
std::vector<FlatCell> FindFlatCells(const Scan& scan, const RegisteredScan& cloud,
                                    const FlatCellOptions& options);

/// Cells that lie in one plane.
struct CoplanarCells {
  Eigen::Vector3d normal;
  Eigen::Vector3d center;
  std::vector<std::size_t> cells;
};

struct CoplanarOptions {
  double distance_m = 0.040;  ///< a bent plane of a rig that drifted must stay one
  double normals_rad = 0.35;  ///< of a cell against the plane
  double near_m = 0.8;        ///< the first guess is made of cells this near to each other
  int least_cells = 30;
  double least_extent_m = 0.2;  ///< rms, in the plane's narrower direction
  int most_planes = 15;
  int trials = 120;
  std::uint64_t seed = 1;
};

/// The largest planes among the cells, each cell in one at the most. O(planes * trials * cells).
std::vector<CoplanarCells> FindCoplanarCells(const std::vector<FlatCell>& cells,
                                             const CoplanarOptions& options);

}  // namespace foresight
