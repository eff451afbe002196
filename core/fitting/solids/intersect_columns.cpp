#include "core/fitting/solids/intersect_columns.h"

// This file is compiled once per instruction set, and the processor's best is called. No product is
// fused with a sum (CMakeLists.txt): every set then gives the same numbers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fitting/solids/intersect_columns.cpp"
#include "core/base/highway_targets.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/fitting/solids/solid_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

// Parts that a ray enters one after another within this are one body, without an edge between them.
constexpr double kSameSurfaceLane_m = 0.02;
constexpr double kLeastDepth_m = 1e-9;

/// What the rays that miss all parts pass by least.
HWY_INLINE ApproachLanes PassedBy(const PlacedSolids& solids, const RayLanes& ray, Lane reach,
                                  LaneMask missed) {
  ApproachLanes best(All(kInfiniteLane), All(kInfiniteLane));
  for (const PlacedSolid& part : solids.parts) {
    const LaneMask wanted =
        hn::And(missed, PassesNear(ray, part.middle, hn::Add(All(part.bound_m), reach)));
    if (!Any(wanted)) continue;
    const RayLanes local = InSolid(ray, part);
    const ApproachLanes closest = ClosestLanes(part.shape, local, AllOf(part.half), reach, wanted);
    const LaneMask better = hn::And(
        wanted, hn::And(hn::Le(closest.distance, reach), hn::Lt(closest.distance, best.distance)));
    best.distance = hn::IfThenElse(better, hn::Max(closest.distance, All(0.0)), best.distance);
    best.range = hn::IfThenElse(better, closest.range, best.range);
  }
  return best;
}

/// The clearance of rays that enter a part at `range`.
HWY_INLINE Lane ClearanceOfHits(const PlacedSolids& solids, const RayLanes& ray, Lane reach,
                                const double* enters, Lane range, LaneMask hits) {
  Lane clearance = All(kInfiniteLane);
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    const PlacedSolid& part = solids.parts[i];
    const Lane enter = hn::LoadU(Doubles(), enters + i * RayColumns::kLanes);
    const LaneMask wanted = hn::And(hn::And(hits, hn::Gt(clearance, hn::Neg(reach))),
                                    hn::Lt(hn::Sub(enter, range), All(kSameSurfaceLane_m)));
    if (!Any(wanted)) continue;
    const Lane depth = DeepestLanes(part.shape, InSolid(ray, part), AllOf(part.half));
    clearance = hn::IfThenElse(wanted, hn::Min(clearance, depth), clearance);
  }
  return hn::Max(hn::Min(clearance, All(-kLeastDepth_m)),
                 hn::Min(hn::Neg(reach), All(-kLeastDepth_m)));
}

/// Where the rays enter a solid, where that is `wanted`; infinite where they miss it.
HWY_INLINE Lane EnterWhere(LaneMask wanted, const PlacedSolid& solid, const RayLanes& ray) {
  wanted = hn::And(wanted, PassesNear(ray, solid.middle, All(solid.bound_m)));
  if (!Any(wanted)) return All(kInfiniteLane);
  return hn::IfThenElse(wanted, EnterLanes(solid.shape, InSolid(ray, solid), AllOf(solid.half)),
                        All(kInfiniteLane));
}

void EnterColumnsHere(const PlacedSolids& solids, const RayColumns& rays, double* ranges_m) {
  const Doubles d;
  for (std::size_t i = 0; i < rays.Padded(); i += hn::Lanes(d)) {
    const RayLanes ray = RayAt(rays, i);
    const LaneMask near = PassesNear(ray, solids.middle, All(solids.bound_m));
    Lane range = All(kInfiniteLane);
    if (Any(near))
      for (const PlacedSolid& solid : solids.parts)
        range = hn::Min(range, EnterWhere(near, solid, ray));
    hn::StoreU(range, d, ranges_m + i);
  }
}

/// Clearance and range of rays that come `near`. `enters` has a register for each part.
HWY_INLINE ApproachLanes IntersectLanes(const PlacedSolids& solids, const RayLanes& ray, Lane reach,
                                        LaneMask near, double* enters) {
  ApproachLanes intersection(All(kInfiniteLane), All(kInfiniteLane));
  for (std::size_t i = 0; i < solids.parts.size(); ++i) {
    const Lane enter = EnterWhere(near, solids.parts[i], ray);
    hn::StoreU(enter, Doubles(), enters + i * RayColumns::kLanes);
    intersection.range = hn::Min(intersection.range, enter);
  }
  const LaneMask hits = hn::Lt(intersection.range, All(kInfiniteLane));
  if (Any(hits))
    intersection.distance =
        hn::IfThenElse(hits, ClearanceOfHits(solids, ray, reach, enters, intersection.range, hits),
                       intersection.distance);
  const LaneMask missed = hn::AndNot(hits, hn::And(near, hn::Gt(reach, All(0.0))));
  if (Any(missed)) {
    const ApproachLanes passed = PassedBy(solids, ray, reach, missed);
    intersection.distance = hn::IfThenElse(missed, passed.distance, intersection.distance);
    intersection.range = hn::IfThenElse(missed, passed.range, intersection.range);
  }
  return intersection;
}

void IntersectColumnsHere(const PlacedSolids& solids, const RayColumns& rays, double* enters,
                          double* clearances_m, double* ranges_m) {
  const auto intersect = [&](const RayLanes& ray, Lane reach, LaneMask near)
                             HWY_ATTR { return IntersectLanes(solids, ray, reach, near, enters); };
  IntersectNear(solids.middle, solids.bound_m, rays, intersect, clearances_m, ranges_m);
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foresight {

HWY_EXPORT(IntersectColumnsHere);
HWY_EXPORT(EnterColumnsHere);

void IntersectColumns(const PlacedSolids& solids, const RayColumns& rays,
                      std::span<double> clearance_m, std::span<double> range_m) {
  std::vector<double> enters(solids.parts.size() * RayColumns::kLanes);
  HWY_DYNAMIC_DISPATCH(IntersectColumnsHere)
  (solids, rays, enters.data(), clearance_m.data(), range_m.data());
}

void EnterColumns(const PlacedSolids& solids, const RayColumns& rays, std::span<double> range_m) {
  HWY_DYNAMIC_DISPATCH(EnterColumnsHere)(solids, rays, range_m.data());
}

}  // namespace foresight
#endif
