#include "core/fitting/cylinder/fit_cylinder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "core/fitting/best_distinct.h"
#include "core/fitting/cylinder/background_planes.h"
#include "core/fitting/cylinder/box_alternative.h"
#include "core/fitting/cylinder/cylinder_evidence.h"
#include "core/fitting/cylinder/cylinder_search.h"
#include "core/fitting/cylinder/cylinder_state.h"
#include "core/fitting/cylinder/cylinder_verdict.h"
#include "core/fitting/ray_selection.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr int kMinRays = 30;
constexpr int kCoarseRays = 300;
constexpr double kCoarseSigma_m = 0.030;  // a smoother hill to climb first
constexpr std::size_t kFine = 6;          // a table, a wall, what stands behind, and the object
constexpr double kAlike = 0.5;            // of a radius between two axes, and of the radius itself
constexpr double kAlikeAxes = 0.9;        // cosine of the angle between them: 26 deg
// A box that is so much likelier is there, and no cylinder: tables, walls and edges are behind one
// by 40 nats and more, thin pipes that are not told from a bar by up to 23.
constexpr double kBoxInItsPlace_nats = -30.0;
constexpr int kFewHits = 20;
constexpr double kOffPlane_sigmas = 2.5;
constexpr int kSigmaRounds = 2;

/// Streams of the seed: each stage draws its own numbers.
enum Stream : std::uint64_t { kThinning, kPlanes, kSearch };

/// One cylinder's fit while it lasts.
class CylinderFit {
 public:
  CylinderFit(RaySet rays, const FitCylinderOptions& options)
      : rays_(std::move(rays)),
        options_(options),
        bounds_{options.min_radius_m, options.max_radius_m} {
    Random random(options.seed, kPlanes);
    planes_ = FindFlatSurfaces(rays_, random);
  }

  /// Different cylinders after local search, the likeliest first.
  Result<std::vector<CylinderState>> Search(const RunContext& context) const {
    Random random(options_.seed, kSearch);
    RaySet few = Thinned(rays_, kCoarseRays, random);
    few.sigma_m = std::max(few.sigma_m, kCoarseSigma_m);
    std::vector<CylinderState> found;
    // What looks flat may be the front of a thin pipe, or of a thick one: before no plane, before
    // the largest, ...
    for (std::size_t count = 0; count <= planes_.size(); ++count) {
      context.Report(
          0.1 + 0.5 * static_cast<double>(count) / static_cast<double>(planes_.size() + 1),
          "looking for circles");
      const std::span<const Plane> behind = std::span(planes_).first(count);
      const auto more = FindCylinders(BeamLikelihood(few, behind, kRoundCylinderBeams),
                                      PointsOff(behind), options_.up, bounds_, random);
      found.insert(found.end(), more.begin(), more.end());
      if (context.Cancelled()) return Cancelled();
    }
    if (found.empty()) return NothingRound();
    context.Report(0.6, "improving the cylinder");
    for (CylinderState& cylinder : found)
      cylinder = AfterLocalSearchBeforePlanes(few, kRoundCylinderBeams, cylinder, 0.06, 4);
    KeepBestDistinct(kFine, &CylinderState::score, Alike, found);
    if (context.Cancelled()) return Cancelled();
    for (CylinderState& cylinder : found)
      cylinder = AfterLocalSearchBeforePlanes(rays_, CylinderBeams(rays_), cylinder, 0.02, 4);
    KeepBestDistinct(kFine, &CylinderState::score, Alike, found);
    return found;
  }

  /// The likeliest cylinder that nothing refutes; where all are refuted, the likeliest in the
  /// operator's box. A table or a wall may be likelier than either: it is a disc as large as
  /// itself.
  Result<CylinderDetection> Best(const std::vector<CylinderState>& found,
                                 const RunContext& context) const {
    std::vector<CylinderDetection> refuted;
    for (const CylinderState& cylinder : found) {
      context.Report(0.7 + 0.05 * static_cast<double>(refuted.size()), "trying other shapes");
      if (context.Cancelled()) return Cancelled();
      RaySet rays = rays_;
      const CylinderState own = WithOwnSigma(cylinder, rays);
      CylinderDetection detection = Detection(own, rays);
      if (detection.evidence.hits == 0) continue;
      if (!Refuted(detection.evidence)) return detection;
      refuted.push_back(std::move(detection));
    }
    if (refuted.empty()) return NothingRound();
    const auto in_box = std::find_if(refuted.begin(), refuted.end(), [](const auto& detection) {
      return InDrawnBox(detection.evidence);
    });
    return in_box != refuted.end() ? *in_box : refuted.front();
  }

 private:
  CylinderDetection Detection(const CylinderState& cylinder, const RaySet& rays) const {
    CylinderDetection detection;
    const Eigen::Vector3d z =
        cylinder.axis.dot(options_.up) >= 0.0 ? cylinder.axis : -cylinder.axis;
    detection.base_from_object = {RotationBetween(Eigen::Vector3d::UnitZ(), z), cylinder.middle};
    detection.model = {cylinder.radius_m, cylinder.length_m};
    detection.evidence = GatherEvidence(rays, cylinder);
    const BeamLikelihood likelihood(rays, PlanesBeside(cylinder, planes_, rays),
                                    CylinderBeams(rays));
    // Half of Schwarz's penalty for each parameter that a box has more.
    const double measurements =
        std::max(2.0, static_cast<double>(rays.rays.size()) * rays.samples_per_ray);
    detection.evidence.box_margin_nats =
        cylinder.score - BestBoxScore(cylinder, likelihood) +
        0.5 * (kBoxAlternativeParameters - kCylinderParameters) * std::log(measurements);
    SetSigmas(rays, cylinder, detection);
    Assess(rays, bounds_, detection);
    return detection;
  }

  static tl::unexpected<Error> Cancelled() {
    return Fail(ErrorCode::kCancelled, "fitting the cylinder was cancelled");
  }

  static tl::unexpected<Error> NothingRound() {
    return Fail(ErrorCode::kNoConvergence,
                "nothing round in the region: draw it around a pole or a pipe");
  }

  static bool InDrawnBox(const CylinderEvidence& evidence) {
    return evidence.in_drawn_box.value_or(1.0) >= kLeastInDrawnBox;
  }

  /// Something else, or too little to be anything.
  static bool Refuted(const CylinderEvidence& evidence) {
    return evidence.box_margin_nats < kBoxInItsPlace_nats || evidence.hits < kFewHits ||
           !InDrawnBox(evidence);
  }

  /// Nearly the same surface: about the same axis and about as thick.
  static bool Alike(const CylinderState& a, const CylinderState& b) {
    const double least_m = std::min(a.radius_m, b.radius_m);
    return a.FromAxis(b.middle).norm() < kAlike * least_m &&
           std::abs(a.radius_m - b.radius_m) < kAlike * least_m &&
           std::abs(a.axis.dot(b.axis)) > kAlikeAxes;
  }

  std::vector<Eigen::Vector3d> PointsOff(std::span<const Plane> planes) const {
    std::vector<Eigen::Vector3d> points;
    const double off_m = kOffPlane_sigmas * rays_.sigma_m;
    for (const RangeRay& ray : rays_.rays)
      if (!rays_.box || EndsInDrawnBox(rays_, ray, off_m)) points.push_back(ray.Point());
    for (const Plane& plane : planes)
      std::erase_if(points, [&](const Eigen::Vector3d& point) {
        return std::abs(plane.Distance(point)) < off_m;
      });
    return points;
  }

  /// Before the flat surfaces that are not slabs through it.
  CylinderState AfterLocalSearchBeforePlanes(const RaySet& rays, const BeamOptions& beams,
                                             const CylinderState& cylinder, double first_step_m,
                                             int rounds) const {
    const BeamLikelihood likelihood(rays, PlanesBeside(cylinder, planes_, rays), beams);
    return AfterLocalSearch(cylinder, likelihood, bounds_, first_step_m, rounds);
  }

  /// The ranges' deviation and the cylinder depend on each other.
  CylinderState WithOwnSigma(CylinderState cylinder, RaySet& rays) const {
    for (int round = 0; round < kSigmaRounds; ++round) {
      const double sigma_m = RangeSigmaFrom(rays, cylinder);
      if (!std::isfinite(sigma_m)) break;
      rays.sigma_m = sigma_m;
      cylinder = AfterLocalSearchBeforePlanes(rays, CylinderBeams(rays), cylinder, 0.01, 5);
    }
    return cylinder;
  }

  RaySet rays_;
  FitCylinderOptions options_;
  CylinderBounds bounds_;
  std::vector<Plane> planes_;
};

}  // namespace

Status FitCylinderOptions::Check() const {
  if (!(min_radius_m >= 0.002 && min_radius_m < max_radius_m && max_radius_m <= 10.0))
    return Fail(ErrorCode::kInvalidOptions,
                "cylinder fit: radii of {} to {} m; 0.002 to 10, the least first", min_radius_m,
                max_radius_m);
  if (!(std::abs(up.norm() - 1.0) < 1e-6))
    return Fail(ErrorCode::kInvalidOptions, "cylinder fit: up has length {}, not 1", up.norm());
  if (max_rays < kMinRays)
    return Fail(ErrorCode::kInvalidOptions, "cylinder fit: max_rays {} is below {}", max_rays,
                kMinRays);
  return {};
}

Result<CylinderDetection> FitCylinder(const RaySet& all_rays, const FitCylinderOptions& options,
                                      const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(RaySet usable, UsableRays(all_rays, kMinRays, "a cylinder"));
  usable.beams = nullptr;  // a map is taken for what it is
  Random thinning(options.seed, kThinning);
  const CylinderFit fit(Thinned(usable, options.max_rays, thinning), options);
  FORESIGHT_TRY(const std::vector<CylinderState> found, fit.Search(context));
  FORESIGHT_TRY(CylinderDetection detection, fit.Best(found, context));
  detection.origin.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  context.Report(1.0, "cylinder fitted");
  return detection;
}

}  // namespace foresight
