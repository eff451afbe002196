// Rays in registers, one a lane: what intersections of many rays are made of. Included once for
// each instruction set.
#if defined(FORESIGHT_CORE_FITTING_RAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORESIGHT_CORE_FITTING_RAY_LANES_INL_H_
#undef FORESIGHT_CORE_FITTING_RAY_LANES_INL_H_
#else
#define FORESIGHT_CORE_FITTING_RAY_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/fitting/ray_columns.h"

HWY_BEFORE_NAMESPACE();
namespace foresight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, RayColumns::kLanes>;
using Lane = hn::Vec<Doubles>;
using LaneMask = hn::Mask<Doubles>;

constexpr double kInfiniteLane = std::numeric_limits<double>::infinity();
constexpr double kParallelLane = 1e-12;  // of a direction's part, or of its square

HWY_INLINE Lane All(double value) {
  return hn::Set(Doubles(), value);
}
HWY_INLINE LaneMask None() {
  return hn::Lt(All(0.0), All(0.0));
}
HWY_INLINE bool Any(LaneMask mask) {
  return !hn::AllFalse(Doubles(), mask);
}
HWY_INLINE Lane Clamped(Lane value, Lane half) {
  return hn::Min(hn::Max(value, hn::Neg(half)), half);
}

struct Lanes3 {
  Lane x, y, z;

  // Written out: gcc compiles a constructor of its own making for the wrong instruction set.
  HWY_INLINE Lanes3(Lane x_of, Lane y_of, Lane z_of) : x(x_of), y(y_of), z(z_of) {}
};

HWY_INLINE Lane Dot(const Lanes3& a, const Lanes3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Lane DotAcross(const Lanes3& a, const Lanes3& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y));
}
HWY_INLINE Lanes3 AllOf(const double* values) {
  return Lanes3(All(values[0]), All(values[1]), All(values[2]));
}

/// A ray a lane.
struct RayLanes {
  Lanes3 origin, direction;

  HWY_INLINE RayLanes(const Lanes3& origin_of, const Lanes3& direction_of)
      : origin(origin_of), direction(direction_of) {}

  HWY_INLINE Lanes3 At(Lane range) const {
    return Lanes3(hn::Add(origin.x, hn::Mul(range, direction.x)),
                  hn::Add(origin.y, hn::Mul(range, direction.y)),
                  hn::Add(origin.z, hn::Mul(range, direction.z)));
  }
};

/// A closest approach: distance and range.
struct ApproachLanes {
  Lane distance, range;

  HWY_INLINE ApproachLanes(Lane distance_of, Lane range_of)
      : distance(distance_of), range(range_of) {}
};

HWY_INLINE Lanes3 Turned(const double* rotation, const Lanes3& v) {
  return Lanes3(Dot(AllOf(rotation), v), Dot(AllOf(rotation + 3), v), Dot(AllOf(rotation + 6), v));
}

/// In another frame.
HWY_INLINE RayLanes Moved(const double* rotation, const double* offset, const RayLanes& ray) {
  const Lanes3 origin = Turned(rotation, ray.origin);
  return RayLanes(Lanes3(hn::Add(origin.x, All(offset[0])), hn::Add(origin.y, All(offset[1])),
                         hn::Add(origin.z, All(offset[2]))),
                  Turned(rotation, ray.direction));
}

HWY_INLINE LaneMask PassesNear(const RayLanes& ray, const double* middle, Lane bound) {
  const Lanes3 to_middle(hn::Sub(All(middle[0]), ray.origin.x),
                         hn::Sub(All(middle[1]), ray.origin.y),
                         hn::Sub(All(middle[2]), ray.origin.z));
  const Lane along = Dot(to_middle, ray.direction);
  return hn::Le(hn::Sub(Dot(to_middle, to_middle), hn::Mul(along, along)), hn::Mul(bound, bound));
}

HWY_INLINE RayLanes RayAt(const RayColumns& rays, std::size_t i) {
  const Doubles d;
  const auto load = [&d, i](const std::vector<double>& column)
                        HWY_ATTR { return hn::LoadU(d, column.data() + i); };
  return RayLanes(Lanes3(load(rays.origin_x), load(rays.origin_y), load(rays.origin_z)),
                  Lanes3(load(rays.direction_x), load(rays.direction_y), load(rays.direction_z)));
}

/// Clearance and range of all rays: what `intersect` says of those that come near the sphere round
/// an object, asked with the ray, its reach and which lanes come near; infinite for the others.
template <class Intersect>
HWY_INLINE void IntersectNear(const double* middle, double bound_m, const RayColumns& rays,
                              const Intersect& intersect, double* clearances_m, double* ranges_m) {
  const Doubles d;
  for (std::size_t i = 0; i < rays.Padded(); i += hn::Lanes(d)) {
    const RayLanes ray = RayAt(rays, i);
    const Lane reach = hn::LoadU(d, rays.reach_m.data() + i);
    const LaneMask near = PassesNear(ray, middle, hn::Add(All(bound_m), reach));
    ApproachLanes intersection(All(kInfiniteLane), All(kInfiniteLane));
    if (Any(near)) intersection = intersect(ray, reach, near);
    hn::StoreU(intersection.distance, d, clearances_m + i);
    hn::StoreU(intersection.range, d, ranges_m + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace foresight
HWY_AFTER_NAMESPACE();

#endif
