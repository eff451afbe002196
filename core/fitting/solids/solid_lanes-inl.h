// The closed forms of solid_tracer.cpp and closest_on_ray.cpp, a ray a lane. Included once for each
// instruction set.
#if defined(FORESIGHT_CORE_FITTING_SOLIDS_SOLID_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORESIGHT_CORE_FITTING_SOLIDS_SOLID_LANES_INL_H_
#undef FORESIGHT_CORE_FITTING_SOLIDS_SOLID_LANES_INL_H_
#else
#define FORESIGHT_CORE_FITTING_SOLIDS_SOLID_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "core/fitting/ray_lanes-inl.h"
#include "core/fitting/solids/intersect_columns.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

constexpr double kNewtonStepLane_m = 1e-5;
constexpr int kNewtonStepsLane = 12;

HWY_INLINE RayLanes InSolid(const RayLanes& ray, const PlacedSolid& solid) {
  return Moved(solid.part_from_base, solid.offset, ray);
}

/// Where a ray is between two faces, and whether it is anywhere.
struct Between {
  Lane enter, leave;
  LaneMask never;

  HWY_INLINE Between() : enter(All(-kInfiniteLane)), leave(All(kInfiniteLane)), never(None()) {}

  HWY_INLINE void Cut(Lane origin, Lane direction, Lane half) {
    const LaneMask parallel = hn::Lt(hn::Abs(direction), All(kParallelLane));
    never = hn::Or(never, hn::And(parallel, hn::Gt(hn::Abs(origin), half)));
    const Lane inverse = hn::Div(All(1.0), direction);
    const Lane a = hn::Mul(hn::Sub(hn::Neg(half), origin), inverse);
    const Lane b = hn::Mul(hn::Sub(half, origin), inverse);
    enter = hn::IfThenElse(parallel, enter, hn::Max(enter, hn::Min(a, b)));
    leave = hn::IfThenElse(parallel, leave, hn::Min(leave, hn::Max(a, b)));
  }
  /// Infinite where it never is.
  HWY_INLINE Lane Enter() const {
    return hn::IfThenElse(hn::AndNot(never, hn::Lt(enter, leave)), enter, All(kInfiniteLane));
  }
};

HWY_INLINE Lane EnterBoxLanes(const RayLanes& ray, const Lanes3& half) {
  Between between;
  between.Cut(ray.origin.x, ray.direction.x, half.x);
  between.Cut(ray.origin.y, ray.direction.y, half.y);
  between.Cut(ray.origin.z, ray.direction.z, half.z);
  return between.Enter();
}

HWY_INLINE Lane EnterCylinderLanes(const RayLanes& ray, Lane radius, Lane half_length) {
  const Lane a = DotAcross(ray.direction, ray.direction);
  const Lane b = DotAcross(ray.origin, ray.direction);
  const Lane across2 = hn::Sub(DotAcross(ray.origin, ray.origin), hn::Mul(radius, radius));
  const Lane root2 = hn::Sub(hn::Mul(b, b), hn::Mul(a, across2));
  const LaneMask along = hn::Le(a, All(kParallelLane));
  Between between;
  between.never =
      hn::Or(hn::And(along, hn::Gt(across2, All(0.0))), hn::AndNot(along, hn::Le(root2, All(0.0))));
  if (hn::AllTrue(Doubles(), between.never)) return All(kInfiniteLane);
  const Lane root = hn::Sqrt(hn::Max(root2, All(0.0)));
  const Lane inverse = hn::Div(All(1.0), a);
  between.enter = hn::IfThenElse(along, between.enter, hn::Mul(hn::Sub(hn::Neg(b), root), inverse));
  between.leave = hn::IfThenElse(along, between.leave, hn::Mul(hn::Sub(root, b), inverse));
  between.Cut(ray.origin.z, ray.direction.z, half_length);
  return between.Enter();
}

HWY_INLINE Lane EnterSphereLanes(const RayLanes& ray, Lane z, Lane radius) {
  const Lanes3 from(ray.origin.x, ray.origin.y, hn::Sub(ray.origin.z, z));
  const Lane b = Dot(from, ray.direction);
  const Lane root2 = hn::Add(hn::Sub(hn::Mul(b, b), Dot(from, from)), hn::Mul(radius, radius));
  const Lane root = hn::Sqrt(hn::Max(root2, All(0.0)));
  return hn::IfThenElse(hn::Gt(root2, All(0.0)), hn::Sub(hn::Neg(b), root), All(kInfiniteLane));
}

/// Range at which a ray enters a solid; infinite where it misses.
HWY_INLINE Lane EnterLanes(PlacedSolid::Shape shape, const RayLanes& ray, const Lanes3& half) {
  if (shape == PlacedSolid::Shape::kBox) return EnterBoxLanes(ray, half);
  const Lane side = EnterCylinderLanes(ray, half.x, half.z);
  if (shape == PlacedSolid::Shape::kCylinder) return side;
  return hn::Min(side, hn::Min(EnterSphereLanes(ray, half.z, half.x),
                               EnterSphereLanes(ray, hn::Neg(half.z), half.x)));
}

/// How far a coordinate lies beyond a slab of this half thickness, with its sign.
HWY_INLINE Lane Beyond(Lane coordinate, Lane half) {
  return hn::Sub(coordinate, Clamped(coordinate, half));
}

HWY_INLINE ApproachLanes BesideBoxLanes(const RayLanes& ray, const Lanes3& half) {
  Lane low = All(-kInfiniteLane), high = All(kInfiniteLane), at_low = All(0.0), at_high = All(0.0);
  const auto slope = [&](Lane range) HWY_ATTR {
    const Lanes3 point = ray.At(range);
    return Dot(ray.direction,
               Lanes3(Beyond(point.x, half.x), Beyond(point.y, half.y), Beyond(point.z, half.z)));
  };
  const auto face = [&](Lane range, LaneMask crosses) HWY_ATTR {
    const LaneMask counts = hn::And(crosses, hn::And(hn::Gt(range, low), hn::Lt(range, high)));
    const Lane here = slope(range);
    const LaneMask falls = hn::And(counts, hn::Le(here, All(0.0)));
    const LaneMask rises = hn::AndNot(falls, counts);
    low = hn::IfThenElse(falls, range, low);
    at_low = hn::IfThenElse(falls, here, at_low);
    high = hn::IfThenElse(rises, range, high);
    at_high = hn::IfThenElse(rises, here, at_high);
  };
  const auto faces = [&](Lane origin, Lane direction, Lane size) HWY_ATTR {
    const LaneMask crosses = hn::Ge(hn::Mul(direction, direction), All(kParallelLane));
    const Lane inverse = hn::Div(All(1.0), direction);
    face(hn::Mul(hn::Sub(hn::Neg(size), origin), inverse), crosses);
    face(hn::Mul(hn::Sub(size, origin), inverse), crosses);
  };
  faces(ray.origin.x, ray.direction.x, half.x);
  faces(ray.origin.y, ray.direction.y, half.y);
  faces(ray.origin.z, ray.direction.z, half.z);
  const LaneMask has_low = hn::Gt(low, All(-kInfiniteLane));
  const LaneMask has_high = hn::Lt(high, All(kInfiniteLane));
  const Lane between =
      hn::Add(low, hn::Mul(hn::Sub(high, low), hn::Div(hn::Neg(at_low), hn::Sub(at_high, at_low))));
  const Lane range =
      hn::IfThenElse(hn::And(has_low, has_high), between, hn::IfThenElse(has_low, low, high));
  const Lanes3 point = ray.At(range);
  const auto beyond = [](Lane coordinate, Lane size) HWY_ATTR {
    return hn::Max(hn::Sub(hn::Abs(coordinate), size), All(0.0));
  };
  const Lanes3 off(beyond(point.x, half.x), beyond(point.y, half.y), beyond(point.z, half.z));
  return ApproachLanes(hn::Sqrt(Dot(off, off)), range);
}

/// Where the line is nearest to the z axis; beside the origin where it runs along the axis.
HWY_INLINE Lane NearestToAxis(const RayLanes& ray) {
  const Lane across2 = DotAcross(ray.direction, ray.direction);
  const Lane beside = hn::Div(hn::Neg(DotAcross(ray.origin, ray.direction)), across2);
  return hn::IfThenElse(hn::Lt(across2, All(kParallelLane)),
                        hn::Neg(hn::Mul(ray.origin.z, ray.direction.z)), beside);
}

HWY_INLINE ApproachLanes BesideCapsuleLanes(const RayLanes& ray, const Lanes3& half) {
  const Lane beside = NearestToAxis(ray);
  const Lane z = ray.At(beside).z;
  const Lanes3 to_end(hn::Neg(ray.origin.x), hn::Neg(ray.origin.y),
                      hn::Sub(hn::CopySign(half.z, z), ray.origin.z));
  const Lane range = hn::IfThenElse(hn::Gt(hn::Abs(z), half.z), Dot(to_end, ray.direction), beside);
  const Lanes3 point = ray.At(range);
  const Lane end = hn::Max(hn::Sub(hn::Abs(point.z), half.z), All(0.0));
  const Lane radial2 = DotAcross(point, point);
  return ApproachLanes(hn::Sub(hn::Sqrt(hn::Add(radial2, hn::Mul(end, end))), half.x), range);
}

/// Beyond an end of a cylinder the squared distance's derivative rises: by Newton's method.
HWY_INLINE Lane BeyondCylindersEnd(const RayLanes& ray, const Lanes3& half, Lane nearest, Lane z,
                                   LaneMask active) {
  const Lane along = ray.direction.z;
  const Lane beside = hn::Div(hn::Sub(hn::CopySign(half.z, z), ray.origin.z), along);
  Lane low = hn::Min(nearest, beside), high = hn::Max(nearest, beside);
  Lane range = hn::Mul(All(0.5), hn::Add(low, high));
  const Lane across2 = DotAcross(ray.direction, ray.direction);
  const Lane radius2 = hn::Mul(half.x, half.x);
  for (int step = 0; step < kNewtonStepsLane && Any(active); ++step) {
    const Lanes3 point = ray.At(range);
    const Lane radial2 = DotAcross(point, point);
    const LaneMask outside = hn::Gt(radial2, radius2);
    const Lane nearness = hn::Div(All(1.0), hn::Sqrt(radial2));
    const Lane inside = hn::Mul(half.x, nearness);
    const Lane moving = DotAcross(point, ray.direction);
    const Lane off = hn::Sub(All(1.0), inside);
    const Lane turning = hn::Mul(moving, nearness);
    const Lane bend = hn::Add(hn::Mul(across2, off), hn::Mul(hn::Mul(turning, turning), inside));
    const Lane slope = hn::Add(hn::Mul(along, Beyond(point.z, half.z)),
                               hn::IfThenElseZero(outside, hn::Mul(moving, off)));
    const Lane curvature = hn::Add(hn::Mul(along, along), hn::IfThenElseZero(outside, bend));
    const LaneMask rises = hn::Gt(slope, All(0.0));
    high = hn::IfThenElse(hn::And(active, rises), range, high);
    low = hn::IfThenElse(hn::AndNot(rises, active), range, low);
    const Lane newton = hn::Sub(range, hn::Div(slope, curvature));
    const Lane next = hn::IfThenElse(hn::And(hn::Gt(newton, low), hn::Lt(newton, high)), newton,
                                     hn::Mul(All(0.5), hn::Add(low, high)));
    const Lane moved = hn::Abs(hn::Sub(next, range));
    range = hn::IfThenElse(active, next, range);
    active = hn::And(active, hn::Ge(moved, All(kNewtonStepLane_m)));
  }
  return range;
}

/// Whether lines that are nearest to the axis beyond an end of a cylinder, the root of `radial2`
/// from the axis there, can come within reach of it.
HWY_INLINE LaneMask MayReachEnd(const RayLanes& ray, const Lanes3& half, Lane reach, Lane z,
                                Lane radial2) {
  const Lane wide = hn::Add(half.x, reach);
  const Lane chord2 = hn::Sub(hn::Mul(wide, wide), radial2);
  const Lane across2 = DotAcross(ray.direction, ray.direction);
  // How far the line comes down while it is no further than that from the axis.
  const Lane down2 = hn::Div(hn::Mul(chord2, hn::Mul(ray.direction.z, ray.direction.z)), across2);
  const Lane over = hn::Sub(hn::Abs(z), hn::Add(half.z, reach));
  return hn::Or(hn::Le(over, All(0.0)), hn::Le(hn::Mul(over, over), down2));
}

HWY_INLINE ApproachLanes BesideCylinderLanes(const RayLanes& ray, const Lanes3& half, Lane reach,
                                             LaneMask wanted) {
  const Lane nearest = NearestToAxis(ray);
  const Lanes3 at_nearest = ray.At(nearest);
  const Lane radial2 = DotAcross(at_nearest, at_nearest);
  const Lane radial = hn::Sqrt(radial2);
  const Lane gap = hn::Sub(radial, half.x);
  const LaneMask reached = hn::And(wanted, hn::Le(gap, reach));
  const LaneMask beyond = hn::Gt(hn::Abs(at_nearest.z), half.z);
  const LaneMask runs_along = hn::Lt(DotAcross(ray.direction, ray.direction), All(kParallelLane));
  const LaneMask level = hn::Lt(hn::Mul(ray.direction.z, ray.direction.z), All(kParallelLane));
  ApproachLanes closest(hn::IfThenElse(reached, gap, All(kInfiniteLane)), nearest);
  LaneMask of_end = hn::And(reached, beyond);
  if (!Any(of_end)) return closest;
  of_end =
      hn::And(of_end, hn::Or(runs_along, MayReachEnd(ray, half, reach, at_nearest.z, radial2)));
  Lane range = nearest;
  const LaneMask sloping = hn::AndNot(level, of_end);
  if (Any(sloping))
    range = hn::IfThenElse(sloping, BeyondCylindersEnd(ray, half, nearest, at_nearest.z, sloping),
                           nearest);
  const Lanes3 point = ray.At(range);
  const Lane off_radial = hn::Max(hn::Sub(hn::Sqrt(DotAcross(point, point)), half.x), All(0.0));
  const Lane off_end = hn::Max(hn::Sub(hn::Abs(point.z), half.z), All(0.0));
  const Lane off = hn::Sqrt(hn::Add(hn::Mul(off_radial, off_radial), hn::Mul(off_end, off_end)));
  closest.distance =
      hn::IfThenElse(beyond, hn::IfThenElse(of_end, off, All(kInfiniteLane)), closest.distance);
  closest.range = hn::IfThenElse(of_end, range, closest.range);
  return closest;
}

/// The closest approach of lines that miss the solid, where that is `wanted` and within reach;
/// anything further elsewhere.
HWY_INLINE ApproachLanes ClosestLanes(PlacedSolid::Shape shape, const RayLanes& ray,
                                      const Lanes3& half, Lane reach, LaneMask wanted) {
  if (shape == PlacedSolid::Shape::kCapsule) return BesideCapsuleLanes(ray, half);
  if (shape == PlacedSolid::Shape::kCylinder) return BesideCylinderLanes(ray, half, reach, wanted);
  // Most rays miss a box that is larger all round.
  const Lane enter = EnterBoxLanes(
      ray, Lanes3(hn::Add(half.x, reach), hn::Add(half.y, reach), hn::Add(half.z, reach)));
  if (!Any(hn::And(wanted, hn::Lt(enter, All(kInfiniteLane)))))
    return ApproachLanes(All(kInfiniteLane), All(kInfiniteLane));
  return BesideBoxLanes(ray, half);
}

HWY_INLINE Lane DeepestInBoxLanes(const RayLanes& ray, const Lanes3& half) {
  const auto steep = [](Lane direction)
                         HWY_ATTR { return hn::Max(hn::Abs(direction), All(kParallelLane)); };
  const auto ahead = [](Lane origin, Lane direction) HWY_ATTR {
    return hn::IfThenElse(hn::Lt(direction, All(0.0)), hn::Neg(origin), origin);
  };
  const Lane steeps[3] = {steep(ray.direction.x), steep(ray.direction.y), steep(ray.direction.z)};
  const Lane aheads[3] = {ahead(ray.origin.x, ray.direction.x),
                          ahead(ray.origin.y, ray.direction.y),
                          ahead(ray.origin.z, ray.direction.z)};
  const Lane halves[3] = {half.x, half.y, half.z};
  Lane deepest = All(-kInfiniteLane);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const Lane inverse = hn::Div(All(1.0), hn::Add(steeps[i], steeps[j]));
      const auto crossing = [&](int falls, int rises) HWY_ATTR {
        const Lane falling = hn::Neg(hn::Add(aheads[falls], halves[falls]));
        const Lane rising = hn::Sub(aheads[rises], halves[rises]);
        return hn::Mul(hn::Add(hn::Mul(steeps[rises], falling), hn::Mul(steeps[falls], rising)),
                       inverse);
      };
      deepest = hn::Max(deepest, hn::Max(crossing(i, j), crossing(j, i)));
    }
  return deepest;
}

HWY_INLINE Lane DeepestInCylinderLanes(const RayLanes& ray, const Lanes3& half) {
  const Lanes3 nearest = ray.At(NearestToAxis(ray));
  const Lane radial2 = DotAcross(nearest, nearest);
  const Lane in_mantle = hn::Sub(hn::Sqrt(radial2), half.x);
  const Lane beyond_end = hn::Sub(hn::Abs(nearest.z), half.z);
  const LaneMask of_end = hn::Lt(in_mantle, beyond_end);
  if (!Any(of_end)) return in_mantle;
  const Lane across2 = DotAcross(ray.direction, ray.direction), down = hn::Abs(ray.direction.z);
  const Lane wide = hn::Add(half.x, beyond_end);
  const Lane wide2 = hn::Sub(hn::Mul(wide, wide), radial2);
  const Lane root =
      hn::Sqrt(hn::Add(hn::Mul(across2, wide2), hn::Mul(hn::Mul(down, down), radial2)));
  const Lane way = hn::Div(wide2, hn::Add(hn::Mul(wide, down), root));
  return hn::IfThenElse(of_end, hn::Max(hn::Sub(beyond_end, hn::Mul(down, way)), hn::Neg(half.z)),
                        in_mantle);
}

/// How deep lines get in a solid that they enter.
HWY_INLINE Lane DeepestLanes(PlacedSolid::Shape shape, const RayLanes& ray, const Lanes3& half) {
  if (shape == PlacedSolid::Shape::kBox) return DeepestInBoxLanes(ray, half);
  if (shape == PlacedSolid::Shape::kCylinder) return DeepestInCylinderLanes(ray, half);
  return BesideCapsuleLanes(ray, half).distance;
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#endif
