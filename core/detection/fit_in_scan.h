#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/shared_list.h"
#include "core/depth/pipeline.h"
#include "core/detection/detection.h"
#include "core/fitting/cylinder/fit_cylinder.h"
#include "core/fitting/drill/fit_drill.h"
#include "core/fitting/handle/fit_handle.h"
#include "core/fitting/solids/image_edges.h"
#include "core/fitting/terrain/fit_terrain.h"
#include "core/fitting/valve/fit_valve.h"
#include "core/sensor/camera_frame.h"

namespace foresight {

/// What a fit is given to look at.
enum class FitSource {
  kRaw,         ///< the lidar's returns with their own rays
  kDepth,       ///< the masked dense depth, and the lidar's returns behind it
  kDepthAlone,  ///< the masked dense depth alone: what a depth method's map is worth by itself
};

/// What sources are called: "raw", a depth method's name, or that and kAloneSuffix.
inline constexpr std::string_view kAloneSuffix = "-alone";
struct NamedSource {
  FitSource source = FitSource::kRaw;
  DepthMethod method = DepthMethod::kForesight;  ///< where the source is a depth map
};
/// Fails with kInvalidOptions for any other name.
Result<NamedSource> FitSourceFromName(std::string_view name);
std::string NameOf(const NamedSource& source);

/// A scan as far as it has been processed. It owns none of it; frames are shared.
struct ProcessedScan {
  const SensorRig& rig;
  const RegisteredScan& cloud;
  SharedList<CameraFrame> frames = {};  ///< what the camera saw; none = beams alone
  const DepthResult* depth = nullptr;   ///< needed for kDepth and kDepthAlone
  const MaskImage* mask = nullptr;      ///< instead of depth->mask, where a threshold was moved
  /// What a pixel of an outline counts; another value to choose it, 0 = the image is not looked at.
  double outline_weight = ImageEdges::kIndependentPerPixel;
};

/// What to look for, and how; in the order of Detection's alternatives.
using FitOptions = std::variant<FitValveOptions, FitDrillOptions, FitTerrainOptions,
                                FitHandleOptions, FitCylinderOptions>;

/// The defaults for an object seen by a head that is mounted as `robot_from_base` says. `up` is
/// against gravity, in robot, length 1.
FitOptions FitOptionsFor(ObjectKind kind, const Rigid<frame::Robot, frame::Base>& robot_from_base,
                         const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());

/// What a fit is given where nobody says otherwise: a map shows a block's edges finer than lidar
/// returns do (docs/evaluation/terrain.md, "Blocks among other things"); of other objects both are
/// as good, and returns need no map.
FitSource UsualSourceFor(ObjectKind kind, bool has_depth);

/// The rays of a region with the noise and the thinning that belong to the source. Fails as
/// RaysFromScan and RaysFromDepth do, and with kState for a depth that is not there.
Result<RaySet> RaysInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                          BoxRays box_rays = BoxRays::kEndInside);

/// The rays of a masked depth map that comes without a scan, thinned and weighed as RaysInScan does
/// it. Fails as RaysFromDepth does.
Result<RaySet> RaysInDepthMap(const DepthImage& masked_depth_m, const SensorRig& rig,
                              double motor_rad, const Roi& roi, double density,
                              BoxRays box_rays = BoxRays::kEndInside);

/// The rays of a cloud that comes without a scan, with the noise as it is measured in the region;
/// 10 mm where it cannot be told. `sigma_m` says it instead. Fails as RaysFromCloud does.
Result<RaySet> RaysInCloud(std::span<const Eigen::Vector3d> points, const GridPlaces& places,
                           const Eigen::Vector3d& viewpoint, const SensorRig& rig, const Roi& roi,
                           std::optional<double> sigma_m, BoxRays box_rays = BoxRays::kEndInside);

/// The fit that belongs to the options. Fails as FitValve, FitDrill, FitTerrain, FitHandle and
/// FitCylinder do.
Result<Detection> FitInRays(const RaySet& rays, const FitOptions& options,
                            const RunContext& context);

/// Whether fits to a kind look at the image: those whose outline is known.
bool UsesImage(ObjectKind kind);

/// Gives the rays of a region.
using RaysOfRegion = std::function<Result<RaySet>(const Roi&, BoxRays)>;

/// Gives what the camera saw round the rays of the region; null where nothing shows it.
using ImageOfRays = std::function<std::shared_ptr<const ImageEdges>(const RaySet&)>;

/// The same for a region whose rays `rays_of` gives. The outline of a UsesImage kind is compared
/// with the image that `image_of` gives; without `image_of` there is none. Of a wheel, a drill or a
/// lever that a box is drawn tightly round, the wall behind the box tells what stands in front of
/// it, so the beams that went through count too. What stands in a large box, as a pier, stands in
/// front of the far wall itself and may hide the object: where that fit is UNSURE or finds nothing,
/// the rays that end inside are tried alone, and the answer of the higher probability is given. A
/// terrain's box holds its ground. Of a cylinder the beams that went past on both sides fix the
/// radius: they always count. A door handle and a drill are told what lies within 0.5 m of the
/// region's middle, too (RaySet::around). Fails as the first of both fits, and as `rays_of`.
Result<Detection> FitInRegion(const RaysOfRegion& rays_of, const ImageOfRays& image_of,
                              const Roi& roi, const FitOptions& options, const RunContext& context);

/// From a region to a detection, with the noise and the thinning that belong to the source: the one
/// way that every program takes, so that a number never differs between them. A depth map alone is
/// judged without the image. Region and source are noted in the result. Fails as RaysInScan and
/// FitInRays do.
Result<Detection> FitInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                            const FitOptions& options, const RunContext& context);

/// The same for one kind of object.
Result<ValveDetection> FitValveInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                                      const FitValveOptions& options, const RunContext& context);

}  // namespace foresight
