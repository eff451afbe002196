#include "core/detection/fit_in_scan.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/depth/depth_method.h"
#include "core/detection/fit_option_table.h"
#include "core/detection/image_of_region.h"
#include "core/fitting/range_noise.h"
#include "core/fitting/ray_selection.h"

namespace foresight {
namespace {

/// Deviation of a range where a region is too small to tell.
constexpr double kRangeSigma_m = 0.010;
/// Neighbouring pixels of a dense map say the same twice.
constexpr int kDepthStride_px = 2;
/// From the middle of a region: beyond the edge of a handle's door, and of what a drill stands on.
constexpr double kSurroundings_m = 0.5;

RaySet WithOwnSigma(RaySet rays) {
  const double sigma_m = EstimateRangeSigma(rays);
  if (std::isfinite(sigma_m)) rays.sigma_m = sigma_m;
  return rays;
}

/// With what lies round a place; without it where that has no rays.
RaySet WithSurroundings(RaySet rays, const Eigen::Vector3d& place, const RaysOfRegion& rays_of) {
  const BoxRoi box{{Eigen::Quaterniond::Identity(), place},
                   Eigen::Vector3d::Constant(2.0 * kSurroundings_m)};
  if (auto around = rays_of(box, BoxRays::kEndInside))
    rays.around = std::make_shared<const RaySet>(std::move(*around));
  return rays;
}

Result<Detection> FitOf(const RaySet& rays, const FitOptions& options, const RunContext& context) {
  if (const auto* drill = std::get_if<FitDrillOptions>(&options))
    return FitDrill(rays, *drill, context);
  if (const auto* terrain = std::get_if<FitTerrainOptions>(&options))
    return FitTerrain(rays, *terrain, context);
  if (const auto* handle = std::get_if<FitHandleOptions>(&options))
    return FitHandle(rays, *handle, context);
  if (const auto* cylinder = std::get_if<FitCylinderOptions>(&options))
    return FitCylinder(rays, *cylinder, context);
  return FitValve(rays, std::get<FitValveOptions>(options), context);
}

}  // namespace

Result<NamedSource> FitSourceFromName(std::string_view name) {
  if (name == "raw") return NamedSource();
  NamedSource named{FitSource::kDepth, {}};
  std::string_view method = name;
  if (method.ends_with(kAloneSuffix)) {
    named.source = FitSource::kDepthAlone;
    method.remove_suffix(kAloneSuffix.size());
  }
  FORESIGHT_TRY(named.method, DepthMethodFromName(std::string(method)));
  return named;
}

std::string NameOf(const NamedSource& source) {
  if (source.source == FitSource::kRaw) return "raw";
  std::string name = InfoOf(source.method).name;
  if (source.source == FitSource::kDepthAlone) name += kAloneSuffix;
  return name;
}

FitOptions FitOptionsFor(ObjectKind kind, const Rigid<frame::Robot, frame::Base>& robot_from_base,
                         const Eigen::Vector3d& up_in_robot) {
  const Eigen::Vector3d up = robot_from_base.Inverse().Rotate(up_in_robot);
  switch (kind) {
    case ObjectKind::kValve:
      break;
    case ObjectKind::kDrill: {
      FitDrillOptions options;
      options.up = up;
      return options;
    }
    case ObjectKind::kTerrain: {
      FitTerrainOptions options;
      options.up = up;
      return options;
    }
    case ObjectKind::kHandle:
      return FitHandleOptions();
    case ObjectKind::kCylinder: {
      FitCylinderOptions options;
      options.up = up;
      return options;
    }
  }
  return FitValveOptions();
}

FitSource UsualSourceFor(ObjectKind kind, bool has_depth) {
  return kind == ObjectKind::kTerrain && has_depth ? FitSource::kDepth : FitSource::kRaw;
}

bool UsesImage(ObjectKind kind) {
  return kind != ObjectKind::kCylinder;
}

Result<RaySet> RaysInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                          BoxRays box_rays) {
  if (source == FitSource::kRaw)
    return RaysFromScan(scan.cloud, scan.rig, roi, kRangeSigma_m, box_rays).transform(WithOwnSigma);
  if (scan.depth == nullptr)
    return Fail(ErrorCode::kState,
                "there is no depth map yet; compute it first, or fit to the raw returns");
  const auto with_beams = [&](RaySet rays) {
    if (source == FitSource::kDepthAlone) return rays;
    if (auto beams = RaysInScan(scan, FitSource::kRaw, roi, box_rays))
      rays.beams = std::make_shared<const RaySet>(std::move(*beams));
    return rays;
  };
  const MaskImage& mask = scan.mask != nullptr ? *scan.mask : scan.depth->mask;
  return RaysInDepthMap(ApplyMask(scan.depth->dense.depth_m, mask), scan.rig,
                        scan.depth->samples.motor_rad, roi, LocalDensity(scan.depth->samples),
                        box_rays)
      .transform(with_beams);
}

Result<RaySet> RaysInDepthMap(const DepthImage& masked_depth_m, const SensorRig& rig,
                              double motor_rad, const Roi& roi, double density, BoxRays box_rays) {
  return RaysFromDepth(masked_depth_m, rig, motor_rad, roi, kDepthStride_px, kRangeSigma_m, density,
                       box_rays);
}

Result<RaySet> RaysInCloud(std::span<const Eigen::Vector3d> points, const GridPlaces& places,
                           const Eigen::Vector3d& viewpoint, const SensorRig& rig, const Roi& roi,
                           std::optional<double> sigma_m, BoxRays box_rays) {
  auto rays = RaysFromCloud(points, viewpoint, &rig, roi, sigma_m.value_or(kRangeSigma_m), box_rays,
                            &places);
  return sigma_m || !rays ? std::move(rays) : std::move(rays).transform(WithOwnSigma);
}

Result<Detection> FitInRays(const RaySet& rays, const FitOptions& options,
                            const RunContext& context) {
  return FitOf(rays, options, context).transform([&](Detection detection) {
    OriginOf(detection).image = rays.image != nullptr;
    return detection;
  });
}

Result<Detection> FitInRegion(const RaysOfRegion& rays_of, const ImageOfRays& image_of,
                              const Roi& roi, const FitOptions& options,
                              const RunContext& context) {
  const bool is_box = std::holds_alternative<BoxRoi>(roi);
  const auto rays_in_roi = [&](BoxRays box_rays) -> Result<RaySet> {
    FORESIGHT_TRY(RaySet rays, rays_of(roi, box_rays));
    if (is_box) rays.box = std::get<BoxRoi>(roi);
    if (image_of && UsesImage(ObjectKindOf(options))) rays.image = image_of(rays);
    const bool is_handle = std::holds_alternative<FitHandleOptions>(options);
    if (!is_handle && !std::holds_alternative<FitDrillOptions>(options)) return rays;
    const Eigen::Vector3d place = is_handle ? MedianPlace(rays.rays) : PlaceInMiddle(rays);
    return WithSurroundings(std::move(rays), place, rays_of);
  };
  if (std::holds_alternative<FitTerrainOptions>(options) || !is_box) {
    FORESIGHT_TRY(const RaySet rays, rays_in_roi(BoxRays::kEndInside));
    return FitInRays(rays, options, context);
  }
  FORESIGHT_TRY(const RaySet through, rays_in_roi(BoxRays::kPassThrough));
  if (std::holds_alternative<FitCylinderOptions>(options))
    return FitInRays(through, options, context);
  Result<Detection> best = FitInRays(through, options, context.Part(0.0, 0.5));
  if (context.Cancelled() || (best && VerdictOf(*best).level != VerdictLevel::kUnsure)) return best;
  const auto rays = rays_in_roi(BoxRays::kEndInside);
  if (!rays) return best;
  Result<Detection> inside = FitInRays(*rays, options, context.Part(0.5, 1.0));
  const bool better =
      inside && (!best || VerdictOf(*inside).probability > VerdictOf(*best).probability);
  return better ? inside : best;
}

Result<Detection> FitInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                            const FitOptions& options, const RunContext& context) {
  const auto rays_of = [&](const Roi& region, BoxRays box) {
    return RaysInScan(scan, source, region, box);
  };
  const auto image_of = [&](const RaySet& rays) {
    return ImageOfRegion(scan.frames, scan.rig, roi, rays, scan.outline_weight);
  };
  const bool looks_at_image = source != FitSource::kDepthAlone && scan.outline_weight > 0.0;
  FORESIGHT_TRY(Detection detection,
                FitInRegion(rays_of, looks_at_image ? ImageOfRays(image_of) : ImageOfRays(), roi,
                            options, context));
  OriginOf(detection).roi = roi;
  OriginOf(detection).source = NameOf(
      {source, scan.depth != nullptr ? scan.depth->options.method : DepthMethod::kForesight});
  return detection;
}

Result<ValveDetection> FitValveInScan(const ProcessedScan& scan, FitSource source, const Roi& roi,
                                      const FitValveOptions& options, const RunContext& context) {
  FORESIGHT_TRY(Detection detection, FitInScan(scan, source, roi, options, context));
  return std::get<ValveDetection>(std::move(detection));
}

}  // namespace foresight
