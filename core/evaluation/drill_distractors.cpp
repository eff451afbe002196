#include "core/evaluation/drill_distractors.h"

#include <array>
#include <utility>

#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using LocalPose = Rigid<frame::Object, frame::Object>;

LocalPose At(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

/// Shapes of one material that stand at a place.
class Thing {
 public:
  Thing(const Rigid<frame::Robot, frame::Object>& place, const Material& material) : place_(place) {
    mesh_.name = "thing";
    mesh_.material = material;
    mesh_.robot_from_object = place;
  }

  void Add(const Shape& shape, const LocalPose& at) { AppendShape(shape, place_ * at, mesh_); }
  /// Upright, standing at a height.
  void AddCylinder(double radius, double from, double to, double x = 0.0) {
    Add(CylinderShape(radius, to - from), At(x, 0.0, 0.5 * (from + to)));
  }
  void MoveTo(Scene& scene) { scene.meshes.push_back(std::move(mesh_)); }

 private:
  Rigid<frame::Robot, frame::Object> place_;
  SceneMesh mesh_;
};

void AddLamp(Thing& thing, Random& random) {
  const double height = random.Uniform(0.22, 0.32);
  thing.AddCylinder(random.Uniform(0.05, 0.08), 0.0, 0.02);
  thing.AddCylinder(0.010, 0.02, height);
  const double reach = random.Uniform(0.06, 0.14);
  thing.Add(CylinderShape(0.009, reach), PoseAlong({0, 0, height}, {reach, 0, height}));
  thing.Add(CylinderShape(random.Uniform(0.035, 0.055), 0.07), At(reach, 0.0, height - 0.02));
}

void AddSprayCan(Thing& thing, Random& random) {
  const double radius = random.Uniform(0.025, 0.033), height = random.Uniform(0.15, 0.20);
  thing.AddCylinder(radius, 0.0, height);
  thing.AddCylinder(0.6 * radius, height, height + 0.03);
}

void AddBottle(Thing& thing, Random& random) {
  const double radius = random.Uniform(0.028, 0.045), height = random.Uniform(0.16, 0.28);
  thing.AddCylinder(radius, 0.0, 0.7 * height);
  thing.AddCylinder(random.Uniform(0.010, 0.016), 0.7 * height, height);
}

void AddMug(Thing& thing, Random& random) {
  const double radius = random.Uniform(0.036, 0.045), height = random.Uniform(0.09, 0.12);
  thing.AddCylinder(radius, 0.0, height);
  const Eigen::AngleAxisd upright(RadiansFromDegrees(90.0), Eigen::Vector3d::UnitX());
  thing.Add(TorusShape(0.030, 0.006), {Eigen::Quaterniond(upright), {radius, 0.0, 0.5 * height}});
}

}  // namespace

std::span<const DrillDistractor> DrillDistractors() {
  using enum DrillDistractor;
  static constexpr std::array kAll = {
      kNothing,           kWall,          kTableEdge, kBox, kBottle,
      kBoxBesideCylinder, kBoxOnCylinder, kLamp,      kMug, kSprayCan};
  return kAll;
}

const char* NameOf(DrillDistractor thing) {
  switch (thing) {
    case DrillDistractor::kNothing:
      return "empty table";
    case DrillDistractor::kWall:
      return "wall";
    case DrillDistractor::kTableEdge:
      return "table's edge";
    case DrillDistractor::kBox:
      return "box";
    case DrillDistractor::kBottle:
      return "bottle";
    case DrillDistractor::kBoxBesideCylinder:
      return "box beside a cylinder";
    case DrillDistractor::kBoxOnCylinder:
      return "box on a cylinder";
    case DrillDistractor::kLamp:
      return "lamp";
    case DrillDistractor::kMug:
      return "mug";
    case DrillDistractor::kSprayCan:
      return "spray can";
  }
  return "";
}

void AddDrillDistractor(DrillDistractor kind, const Rigid<frame::Robot, frame::Object>& place,
                        const Material& material, Random& random, Scene& scene) {
  Thing thing(place, material);
  switch (kind) {
    case DrillDistractor::kNothing:
    case DrillDistractor::kWall:
    case DrillDistractor::kTableEdge:
      return;
    case DrillDistractor::kBox: {
      const Eigen::Vector3d size(random.Uniform(0.05, 0.18), random.Uniform(0.05, 0.18),
                                 random.Uniform(0.10, 0.28));
      thing.Add(BoxShape(size), At(0.0, 0.0, 0.5 * size.z()));
      break;
    }
    case DrillDistractor::kBottle:
      AddBottle(thing, random);
      break;
    case DrillDistractor::kBoxBesideCylinder: {
      const double radius = random.Uniform(0.022, 0.040);
      const Eigen::Vector3d size(random.Uniform(0.05, 0.12), random.Uniform(0.05, 0.10),
                                 random.Uniform(0.05, 0.20));
      thing.AddCylinder(radius, 0.0, random.Uniform(0.15, 0.25));
      thing.Add(BoxShape(size), At(radius + 0.5 * size.x() + 0.005, 0.0, 0.5 * size.z()));
      break;
    }
    case DrillDistractor::kBoxOnCylinder: {
      const double height = random.Uniform(0.14, 0.20);
      const Eigen::Vector3d size(random.Uniform(0.12, 0.20), random.Uniform(0.05, 0.08),
                                 random.Uniform(0.04, 0.08));
      thing.AddCylinder(random.Uniform(0.022, 0.035), 0.0, height);
      thing.Add(BoxShape(size), At(random.Uniform(-0.03, 0.03), 0.0, height + 0.5 * size.z()));
      break;
    }
    case DrillDistractor::kLamp:
      AddLamp(thing, random);
      break;
    case DrillDistractor::kMug:
      AddMug(thing, random);
      break;
    case DrillDistractor::kSprayCan:
      AddSprayCan(thing, random);
      break;
  }
  thing.MoveTo(scene);
}

}  // namespace foresight
