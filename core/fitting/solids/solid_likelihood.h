#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/solids/image_edges.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/geometry/plane.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// No real drill is made of cylinders and boxes: by how much its surface lies beside them, 1 sigma.
inline constexpr double kDrillTemplateError_m = 0.005;
/// The same of its outline, as seen by a beam that passes.
inline constexpr double kDrillEdgeError_m = 0.003;

/// How well solids at a place explain every ray of a region: those that should intersect them, and
/// those that went past or through. The same rays score every shape, a drill or a box, so scores
/// compare directly. The terms are those of the valve's RayLikelihood.
///
/// A ray that intersects a solid returns its range with probability 0.93 (or something nearer, or
/// nonsense); one that passes within its footprint may have touched it; all others return one of
/// the planes behind, or anything. Where an image shows the region (RaySet::image) the solids'
/// outline must lie on its edges.
class SolidLikelihood {
 public:
  /// `planes` = what lies behind: table, walls. Keeps a copy of the rays.
  SolidLikelihood(RaySet rays, std::span<const Plane> planes);

  const RaySet& rays() const { return rays_; }

  /// Log likelihood of all rays in nats, counted as independent measurements, and of the image.
  double operator()(std::span<const SolidPart> parts,
                    const Rigid<frame::Base, frame::Object>& base_from_object) const;
  /// Of each ray, weighted as in the sum; not of the beams behind a dense map.
  Eigen::VectorXd LogOfRays(std::span<const SolidPart> parts,
                            const Rigid<frame::Base, frame::Object>& base_from_object) const;
  /// By how many deviations the first solids at their place explain the rays better than the second
  /// at theirs, when scan lines and not beams are independent (DeviationsOverLines). Of the beams
  /// alone where they stand behind a dense map: its rows are no lines.
  double DeviationsAhead(std::span<const SolidPart> first,
                         const Rigid<frame::Base, frame::Object>& base_from_first,
                         std::span<const SolidPart> second,
                         const Rigid<frame::Base, frame::Object>& base_from_second) const;
  /// What the image says of their outline; nothing where there is none.
  OutlineSupport OfImage(std::span<const SolidPart> parts,
                         const Rigid<frame::Base, frame::Object>& base_from_object) const;
  /// The same with nothing there but the planes.
  double Nothing() const;

  /// The same for the rays that pass within `reach_m` of these solids alone, without beams and
  /// image.
  SolidLikelihood Near(std::span<const SolidPart> parts,
                       const Rigid<frame::Base, frame::Object>& base_from_object,
                       double reach_m) const;

 private:
  struct RayNoise {
    double sigma_m = 0.0;     ///< of the range, with the template's own inaccuracy
    double width_m = 0.0;     ///< how far beside the ray its footprint still touches
    double background = 0.0;  ///< density of the measured range without a solid
    double log_background = 0.0;
  };

  SolidLikelihood() = default;
  double OfRays(std::span<const SolidPart> parts,
                const Rigid<frame::Base, frame::Object>& base_from_object) const;
  double OfRay(std::size_t i, const SolidIntersection& intersection) const;
  double OfNothing() const;

  RaySet rays_;
  std::vector<RayNoise> noise_;
  std::shared_ptr<const SolidLikelihood> beams_;  ///< behind a dense map; null = not known
};

}  // namespace foresight
