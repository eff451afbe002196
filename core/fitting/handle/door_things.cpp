#include "core/fitting/handle/door_things.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/fitting/solids/solid_coverage.h"

namespace foresight {
namespace {

constexpr double kLeastSine = 0.3;  // a ray along a bar enters it no earlier than this says
constexpr double kLeastLength_m = 1e-9;
constexpr double kGoesOnCosine = 0.7;  // a return or a neck does not

double PlateReach(const DoorThing::Plate& plate) {
  return std::hypot(plate.front_m, plate.at.norm() + std::max(plate.radius_m, plate.half_m.norm()));
}

}  // namespace

DoorThing::DoorThing(const std::vector<HandleBar>& bars, const std::vector<Plate>& plates,
                     const Rigid<frame::Base, frame::Object>& base_from_object)
    : base_from_object_(base_from_object),
      object_from_base_(base_from_object.RotationMatrix().transpose()),
      position_(base_from_object.translation()) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const HandleBar& bar : bars) {
    const Eigen::Vector3d way = bar.to - bar.from;
    const double length_m = way.norm();
    bars_.push_back({bar.from, way / std::max(length_m, kLeastLength_m), length_m, bar.radius_m,
                     0.5 * (bar.from + bar.to), 0.5 * length_m + bar.radius_m});
    middle += (bar.from + bar.to) / (2.0 * static_cast<double>(bars.size()));
  }
  for (const HandleBar& bar : bars)
    bound_m_ = std::max({bound_m_, (bar.from - middle).norm() + bar.radius_m,
                         (bar.to - middle).norm() + bar.radius_m});
  for (const Plate& plate : plates) {
    plates_.push_back({plate, {std::cos(plate.turn_rad), std::sin(plate.turn_rad)}});
    bound_m_ = std::max(bound_m_, middle.norm() + PlateReach(plate));
  }
  middle_ = base_from_object * middle;
}

std::optional<BeamIntersection> DoorThing::IntersectBar(const LocalRay& ray, const Bar& bar,
                                                        double reach_m) {
  const Eigen::Vector3d to_middle = bar.middle - ray.origin;
  const double nearest_m = to_middle.dot(ray.direction), bound_m = bar.bound_m + reach_m;
  if (to_middle.squaredNorm() - nearest_m * nearest_m > bound_m * bound_m) return std::nullopt;
  const Eigen::Vector3d from = ray.origin - bar.from;
  const double cosine = ray.direction.dot(bar.along), closing = ray.direction.dot(from);
  const double sine2 = 1.0 - cosine * cosine;
  double s = sine2 > 1e-9 ? (bar.along.dot(from) - cosine * closing) / sine2 : 0.0;
  const bool beyond_end = !(s > 0.0 && s < bar.length_m);
  s = std::clamp(s, 0.0, bar.length_m);
  const double middle_m = cosine * s - closing;
  const double offset2 = (from + middle_m * ray.direction - s * bar.along).squaredNorm();
  const double touched_m = bar.radius_m + reach_m;
  if (offset2 > touched_m * touched_m) return std::nullopt;
  const double depth2 = bar.radius_m * bar.radius_m - offset2;
  BeamIntersection intersection{std::sqrt(offset2) - bar.radius_m, middle_m};
  if (depth2 > 0.0)
    intersection.range_m -=
        std::sqrt(depth2) / (beyond_end ? 1.0 : std::max(kLeastSine, std::sqrt(sine2)));
  return intersection;
}

std::optional<BeamIntersection> DoorThing::IntersectPlate(const LocalRay& ray,
                                                          const TurnedPlate& turned) {
  const Plate& plate = turned.plate;
  if (ray.direction.z() > -1e-3) return std::nullopt;
  const double range_m = (plate.front_m - ray.origin.z()) / ray.direction.z();
  const Eigen::Vector2d at = (ray.origin + range_m * ray.direction).head<2>() - plate.at;
  const auto beyond_rectangle = [&] {
    const Eigen::Vector2d& x = turned.along;
    const Eigen::Vector2d own(x.dot(at), x.x() * at.y() - x.y() * at.x());
    return (own.cwiseAbs() - plate.half_m).maxCoeff();
  };
  const double beyond_m = plate.radius_m > 0.0 ? at.norm() - plate.radius_m : beyond_rectangle();
  // A plate that is seen from the side is narrower across the ray.
  return BeamIntersection{-ray.direction.z() * beyond_m, range_m};
}

std::optional<BeamIntersection> DoorThing::Intersect(const RangeRay& ray, double reach_m) const {
  const Eigen::Vector3d to_middle = middle_ - ray.origin;
  const double along_m = to_middle.dot(ray.direction);
  const double bound_m = bound_m_ + reach_m;
  if (to_middle.squaredNorm() - along_m * along_m > bound_m * bound_m) return std::nullopt;
  const LocalRay local{object_from_base_ * (ray.origin - position_),
                       object_from_base_ * ray.direction};
  std::optional<BeamIntersection> best;
  const auto consider = [&](const BeamIntersection& passed) {
    if (passed.clearance_m > reach_m) return;
    const bool hits = passed.clearance_m < 0.0;
    const bool first = !best || (hits && !(best->clearance_m < 0.0)) ||
                       (hits && passed.range_m < best->range_m) ||
                       (!hits && passed.clearance_m < best->clearance_m);
    if (first) best = passed;
  };
  for (const Bar& bar : bars_)
    if (const auto passed = IntersectBar(local, bar, reach_m)) consider(*passed);
  for (const TurnedPlate& plate : plates_)
    if (const auto passed = IntersectPlate(local, plate)) consider(*passed);
  return best;
}

PlacedDoorThing DoorThing::Placed() const {
  PlacedDoorThing placed;
  for (const Bar& bar : bars_) {
    PlacedDoorThing::Bar& made = placed.bars.emplace_back();
    Eigen::Vector3d::Map(made.from) = bar.from;
    Eigen::Vector3d::Map(made.along) = bar.along;
    made.length_m = bar.length_m;
    made.radius_m = bar.radius_m;
    Eigen::Vector3d::Map(made.middle) = bar.middle;
    made.bound_m = bar.bound_m;
  }
  for (const TurnedPlate& turned : plates_) {
    PlacedDoorThing::Plate& made = placed.plates.emplace_back();
    made.front_m = turned.plate.front_m;
    Eigen::Vector2d::Map(made.at) = turned.plate.at;
    Eigen::Vector2d::Map(made.along) = turned.along;
    made.radius_m = turned.plate.radius_m;
    Eigen::Vector2d::Map(made.half_m) = turned.plate.half_m;
  }
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(placed.object_from_base) = object_from_base_;
  Eigen::Vector3d::Map(placed.offset) = -(object_from_base_ * position_);
  Eigen::Vector3d::Map(placed.middle) = middle_;
  placed.bound_m = bound_m_;
  return placed;
}

std::vector<SolidPart> DoorThing::Parts() const {
  std::vector<SolidPart> parts;
  // A bar that goes on as the next one, bent a little, is outlined along its sides alone.
  const auto goes_on = [&](std::size_t i, std::size_t next) {
    if (next >= bars_.size()) return false;
    const Bar &a = bars_[std::min(i, next)], &b = bars_[std::max(i, next)];
    return (a.from + a.length_m * a.along - b.from).norm() < kLeastLength_m &&
           a.radius_m == b.radius_m && a.along.dot(b.along) > kGoesOnCosine;
  };
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const Bar& bar = bars_[i];
    parts.push_back({.name = "bar",
                     .shape = SolidPart::Shape::kCapsule,
                     .object_from_part = {Eigen::Quaterniond::FromTwoVectors(
                                              Eigen::Vector3d::UnitZ(), bar.along),
                                          bar.from + 0.5 * bar.length_m * bar.along},
                     .size_m = {2.0 * bar.radius_m, 2.0 * bar.radius_m, bar.length_m},
                     .joined = {i > 0 && goes_on(i, i - 1), goes_on(i, i + 1)}});
  }
  const double thickness_m = HandleModel::kPlateThickness_m;
  for (const TurnedPlate& turned : plates_) {
    const Plate& plate = turned.plate;
    SolidPart part{
        .name = "plate",
        .shape = SolidPart::Shape::kBox,
        .object_from_part = {Eigen::Quaterniond(
                                 Eigen::AngleAxisd(plate.turn_rad, Eigen::Vector3d::UnitZ())),
                             {plate.at.x(), plate.at.y(), plate.front_m - 0.5 * thickness_m}},
        .size_m = {2.0 * plate.half_m.x(), 2.0 * plate.half_m.y(), thickness_m}};
    if (plate.radius_m > 0.0) {
      part.shape = SolidPart::Shape::kCylinder;
      part.size_m.head<2>().setConstant(2.0 * plate.radius_m);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

DoorThing::Plate PlateOf(HandleModel::Plate kind, double standoff_m) {
  DoorThing::Plate plate;
  plate.front_m = HandleModel::kPlateThickness_m - standoff_m;
  if (kind == HandleModel::Plate::kRosette)
    plate.radius_m = HandleModel::kRosetteRadius_m;
  else
    plate.half_m = {0.5 * HandleModel::kPlateWidth_m, 0.5 * HandleModel::kPlateLength_m};
  return plate;
}

DoorThing ThingOf(const HandleModel& model,
                  const Rigid<frame::Base, frame::Object>& base_from_object) {
  return DoorThing(BarsOf(model), {PlateOf(model.plate, model.standoff_m)}, base_from_object);
}

CoverBeam CoverBy(DoorThing thing) {
  return CoverBySamples([thing = std::move(thing)](const RangeRay& ray, double reach_m) {
    return thing.Intersect(ray, reach_m);
  });
}

CoverBeams CoverAllBy(const DoorThing& thing) {
  return CoverAllBySamples([placed = thing.Placed()](const RayColumns& rays,
                                                     std::span<double> clearance_m,
                                                     std::span<double> range_m) {
    IntersectColumns(placed, rays, clearance_m, range_m);
  });
}

OutlineSupport OfImage(const DoorThing& thing, const RaySet& rays) {
  return OfImage(thing.Parts(), thing.base_from_object(), rays);
}

double LogLikelihoodOf(const DoorThing& thing, const BeamLikelihood& likelihood) {
  return likelihood(CoverAllBy(thing)) + OfImage(thing, likelihood.rays()).nats;
}

}  // namespace foresight
