#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/depth/upsample.h"
#include "core/fitting/roi.h"
#include "core/registration/register_scan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

struct GridPlaces;
class ImageEdges;

/// One measurement with the line of sight it was made along.
struct RangeRay {
  Eigen::Vector3d origin;     ///< in base
  Eigen::Vector3d direction;  ///< in base, length 1
  double range_m = 0.0;       ///< along direction
  /// Where on the grid it was measured, (beam, line) of a scan or (column, row) of a depth map's
  /// sampled pixels: neighbours differ by 1. (-1, -1) = a cloud without a grid.
  Eigen::Vector2i cell = Eigen::Vector2i::Constant(-1);

  Eigen::Vector3d Point() const { return origin + range_m * direction; }
};

/// What a fit looks at: the rays of a region of interest, and how good they are.
struct RaySet {
  std::vector<RangeRay> rays;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();  ///< in base: mean origin
  double sigma_m = 0.010;                               ///< standard deviation of a range
  double footprint_rad = 0.004;                         ///< full angle between neighbouring rays
  bool dense = false;            ///< from an upsampled map: neighbouring rays are not independent
  double samples_per_ray = 1.0;  ///< independent measurements behind a ray; < 1 for a dense map
  /// Full angle of a beam's footprint across its scan line; 0 = round, footprint_rad wide. Where a
  /// footprint lies on two surfaces the range is one in between.
  double footprint_height_rad = 0.0;
  /// The box that the operator put round the object; nullopt where the region is another one. What
  /// ends outside it, in front or behind, is not the object.
  std::optional<BoxRoi> box = {};
  /// The lidar's own returns in the region, behind a dense map; null where they are not known. A
  /// map guesses between them, so they have a say in which of several answers is right and where it
  /// is.
  std::shared_ptr<const RaySet> beams = nullptr;
  /// What lies round the region, the region's own rays among it: what an object stands on goes on
  /// beyond what an operator draws. Null where it is not known.
  std::shared_ptr<const RaySet> around = nullptr;
  /// What the camera saw round the region; null where no image shows it. For objects whose outline
  /// is known.
  std::shared_ptr<const ImageEdges> image = nullptr;

  /// What was measured: the beams behind a map where they are known, else these rays. A map is
  /// smooth where an object ends, and says "behind" of pixels that no beam went past.
  const RaySet& Measured() const { return beams ? *beams : *this; }

  /// How many independent measurements a ray is worth, one at most.
  double Worth() const { return std::min(1.0, samples_per_ray); }
};

/// Which rays of a BoxRoi a fit wants. An ImageRoi always holds both.
enum class BoxRays {
  kEndInside,    ///< the measurements in the box
  kPassThrough,  ///< and those that went through it and end behind it: where nothing solid is
};

/// The raw lidar returns inside the region, also those that the depth filters would reject: a fit
/// has its own model of bad returns. Origins are the lidar's on each line. An ImageRoi holds what
/// appears inside its polygon in its image. Fails with kInvalidInput (the region) and
/// kTooFewPoints (nothing inside it). O(points).
Result<RaySet> RaysFromScan(const RegisteredScan& scan, const SensorRig& rig, const Roi& roi,
                            double sigma_m, BoxRays box_rays = BoxRays::kEndInside);

/// First and last row of a scan's points that has one in the region; nullopt where none has, or the
/// region cannot be asked for. O(points).
std::optional<std::pair<int, int>> RowsInRegion(const RegisteredScan& scan, const SensorRig& rig,
                                                const Roi& roi);

/// The masked dense depth of the image taken at `motor_rad` inside the region; every `stride`-th
/// pixel in both directions, seen from the camera's centre. `density` is the fraction of pixels
/// with a lidar measurement of their own: an upsampled map holds no more independent measurements
/// than went into it. Fails with kInvalidInput (the region, also one drawn on another image; the
/// stride; the map's size) and kTooFewPoints. O(pixels of the region).
Result<RaySet> RaysFromDepth(const DepthImage& masked_depth_m, const SensorRig& rig,
                             double motor_rad, const Roi& roi, int stride, double sigma_m,
                             double density, BoxRays box_rays = BoxRays::kEndInside);

/// Points of a cloud in base inside the region, seen from one viewpoint: ranges of a scanner, or a
/// cloud from elsewhere. Points that are not finite are left out. `places`, where the points were
/// measured on a grid, has an entry for each point; null or kScattered = they have no grid.
/// `footprint_rad` is set to the median angle from a point to its nearest neighbour; where the grid
/// is that of a fan that was turned, footprints are as high as in RaysFromScan. Fails with
/// kInvalidInput (the region, an ImageRoi without `rig`; a viewpoint that is not finite) and
/// kTooFewPoints. O(points).
/// @pre places == nullptr or places->line.size() == points.size()
Result<RaySet> RaysFromCloud(std::span<const Eigen::Vector3d> points,
                             const Eigen::Vector3d& viewpoint, const SensorRig* rig, const Roi& roi,
                             double sigma_m, BoxRays box_rays = BoxRays::kEndInside,
                             const GridPlaces* places = nullptr);

}  // namespace foresight
