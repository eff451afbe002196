#include "core/fitting/handle/door_columns.h"

// Compiled once per instruction set, as solids/intersect_columns.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fitting/handle/door_columns.cpp"
#include "core/base/highway_targets.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/fitting/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {

constexpr double kLeastSineLane = 0.3;  // a ray along a bar enters it no earlier than this says
constexpr double kAlongBarLane = 1e-9;  // squared sine of a ray along a bar
constexpr double kFacesPlateLane = -1e-3;

/// What rays meet first so far, else what they pass by least.
struct BestLanes {
  Lane clearance, range, reach;

  HWY_INLINE explicit BestLanes(Lane reach_of)
      : clearance(All(kInfiniteLane)), range(All(kInfiniteLane)), reach(reach_of) {}

  HWY_INLINE void Consider(Lane clearance_of, Lane range_of, LaneMask wanted) {
    const LaneMask hits = hn::Lt(clearance_of, All(0.0));
    const LaneMask nearer =
        hn::And(hits, hn::Or(hn::Ge(clearance, All(0.0)), hn::Lt(range_of, range)));
    const LaneMask closer = hn::AndNot(hits, hn::Lt(clearance_of, clearance));
    const LaneMask first =
        hn::And(hn::And(wanted, hn::Le(clearance_of, reach)), hn::Or(nearer, closer));
    clearance = hn::IfThenElse(first, clearance_of, clearance);
    range = hn::IfThenElse(first, range_of, range);
  }
};

HWY_INLINE void ConsiderBar(const PlacedDoorThing::Bar& bar, const RayLanes& ray, LaneMask wanted,
                            BestLanes& best) {
  wanted = hn::And(wanted, PassesNear(ray, bar.middle, hn::Add(All(bar.bound_m), best.reach)));
  if (!Any(wanted)) return;
  const Lanes3 along = AllOf(bar.along);
  const Lanes3 from(hn::Sub(ray.origin.x, All(bar.from[0])),
                    hn::Sub(ray.origin.y, All(bar.from[1])),
                    hn::Sub(ray.origin.z, All(bar.from[2])));
  const Lane cosine = Dot(ray.direction, along), closing = Dot(ray.direction, from);
  const Lane sine2 = hn::Sub(All(1.0), hn::Mul(cosine, cosine));
  const Lane crossing = hn::Div(hn::Sub(Dot(along, from), hn::Mul(cosine, closing)), sine2);
  const Lane length = All(bar.length_m);
  const Lane at = hn::IfThenElseZero(hn::Gt(sine2, All(kAlongBarLane)), crossing);
  const LaneMask on_side = hn::And(hn::Gt(at, All(0.0)), hn::Lt(at, length));
  const Lane s = hn::Min(hn::Max(at, All(0.0)), length);
  const Lane nearest = hn::Sub(hn::Mul(cosine, s), closing);
  const auto off = [&](Lane origin, Lane direction, Lane axis) HWY_ATTR {
    return hn::Sub(hn::Add(origin, hn::Mul(nearest, direction)), hn::Mul(s, axis));
  };
  const Lanes3 offset(off(from.x, ray.direction.x, along.x), off(from.y, ray.direction.y, along.y),
                      off(from.z, ray.direction.z, along.z));
  const Lane offset2 = Dot(offset, offset);
  const Lane clearance = hn::Sub(hn::Sqrt(offset2), All(bar.radius_m));
  const Lane depth =
      hn::Sqrt(hn::Max(hn::Sub(All(bar.radius_m * bar.radius_m), offset2), All(0.0)));
  const Lane sine = hn::Max(All(kLeastSineLane), hn::Sqrt(hn::Max(sine2, All(0.0))));
  const Lane before = hn::IfThenElse(on_side, hn::Div(depth, sine), depth);
  best.Consider(clearance, hn::Sub(nearest, before), wanted);
}

HWY_INLINE void ConsiderPlate(const PlacedDoorThing::Plate& plate, const RayLanes& ray,
                              LaneMask wanted, BestLanes& best) {
  wanted = hn::And(wanted, hn::Le(ray.direction.z, All(kFacesPlateLane)));
  const Lane range = hn::Div(hn::Sub(All(plate.front_m), ray.origin.z), ray.direction.z);
  const Lanes3 point = ray.At(range);
  const Lane x = hn::Sub(point.x, All(plate.at[0])), y = hn::Sub(point.y, All(plate.at[1]));
  Lane beyond = All(0.0);
  if (plate.radius_m > 0.0) {
    beyond = hn::Sub(hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y))), All(plate.radius_m));
  } else {
    const Lane ax = All(plate.along[0]), ay = All(plate.along[1]);
    const Lane own_x = hn::Add(hn::Mul(ax, x), hn::Mul(ay, y));
    const Lane own_y = hn::Sub(hn::Mul(ax, y), hn::Mul(ay, x));
    beyond = hn::Max(hn::Sub(hn::Abs(own_x), All(plate.half_m[0])),
                     hn::Sub(hn::Abs(own_y), All(plate.half_m[1])));
  }
  // A plate that is seen from the side is narrower across the ray.
  best.Consider(hn::Mul(hn::Neg(ray.direction.z), beyond), range, wanted);
}

void IntersectDoorColumnsHere(const PlacedDoorThing& thing, const RayColumns& rays,
                              double* clearances_m, double* ranges_m) {
  const auto intersect = [&](const RayLanes& ray, Lane reach, LaneMask near) HWY_ATTR {
    BestLanes best(reach);
    const RayLanes local = Moved(thing.object_from_base, thing.offset, ray);
    for (const PlacedDoorThing::Bar& bar : thing.bars) ConsiderBar(bar, local, near, best);
    for (const PlacedDoorThing::Plate& plate : thing.plates)
      ConsiderPlate(plate, local, near, best);
    return ApproachLanes(best.clearance, best.range);
  };
  IntersectNear(thing.middle, thing.bound_m, rays, intersect, clearances_m, ranges_m);
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foresight {

HWY_EXPORT(IntersectDoorColumnsHere);

void IntersectColumns(const PlacedDoorThing& thing, const RayColumns& rays,
                      std::span<double> clearance_m, std::span<double> range_m) {
  HWY_DYNAMIC_DISPATCH(IntersectDoorColumnsHere)
  (thing, rays, clearance_m.data(), range_m.data());
}

}  // namespace foresight
#endif
