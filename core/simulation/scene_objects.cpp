#include "core/simulation/scene_objects.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/contract.h"
#include "core/objects/drill_model.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Object>;
using LocalPose = Rigid<frame::Object, frame::Object>;

/// Collects shapes that share a material.
class Part {
 public:
  Part(const std::string& name, const Pose& robot_from_object, const Material& material)
      : robot_from_object_(robot_from_object) {
    mesh_.name = name;
    mesh_.material = material;
    mesh_.robot_from_object = robot_from_object;
  }

  void Add(const Shape& shape, const LocalPose& object_from_shape) {
    AppendShape(shape, robot_from_object_ * object_from_shape, mesh_);
  }
  void AddAt(const Shape& shape, const Eigen::Vector3d& center) {
    Add(shape, {Eigen::Quaterniond::Identity(), center});
  }
  void AddCylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
    Add(CylinderShape(radius, (to - from).norm()), PoseAlong(from, to));
  }
  void AddCapsule(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
    Add(CapsuleShape(radius, (to - from).norm()), PoseAlong(from, to));
  }
  void MoveTo(Scene& scene) { scene.meshes.push_back(std::move(mesh_)); }

 private:
  Pose robot_from_object_;
  SceneMesh mesh_;
};

constexpr int kSectionCorners = 32;

/// An ellipse about a point, counter-clockwise.
std::vector<Eigen::Vector2d> Ellipse(double half_x, double half_y,
                                     const Eigen::Vector2d& center = Eigen::Vector2d::Zero()) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kSectionCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSectionCorners;
    outline.push_back(center + Eigen::Vector2d(half_x * std::cos(angle), half_y * std::sin(angle)));
  }
  return outline;
}

void AddSpoke(const ValveModel& model, const Eigen::Vector3d& hub, const Eigen::Vector3d& end,
              Part& wheel) {
  if (model.spoke_depth_ratio == 1.0) return wheel.AddCapsule(hub, end, model.spoke_radius_m);
  const std::array path = {hub, end};
  wheel.AddAt(
      SweptShape(Ellipse(model.spoke_radius_m, model.SpokeDepth()), path, Eigen::Vector3d::UnitZ()),
      Eigen::Vector3d::Zero());
}

void AddWheel(const ValveObject& valve, Scene& scene) {
  const ValveModel& model = valve.model;
  const Eigen::Vector3d hub(0.0, 0.0, -model.dish_m);
  Part wheel(valve.name, valve.robot_from_object, valve.wheel_material);
  if (model.rim_depth_ratio == 1.0)
    wheel.AddAt(TorusShape(model.rim_radius_m, model.tube_radius_m), Eigen::Vector3d::Zero());
  else
    wheel.AddAt(
        RevolvedShape(Ellipse(model.tube_radius_m, model.RimDepth(), {model.rim_radius_m, 0.0}),
                      true),
        Eigen::Vector3d::Zero());
  wheel.AddAt(SphereShape(model.hub_radius_m), hub);
  if (model.spokes == 0)
    wheel.AddAt(DishShape(model.rim_radius_m, model.dish_m, 2.0 * model.spoke_radius_m),
                Eigen::Vector3d::Zero());
  for (int i = 0; i < model.spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / model.spokes;
    const Eigen::Vector3d end(model.rim_radius_m * std::cos(angle),
                              model.rim_radius_m * std::sin(angle), 0.0);
    AddSpoke(model, hub, end, wheel);
  }
  wheel.MoveTo(scene);
}

void AddLever(const ValveObject& valve, Scene& scene) {
  const ValveModel& model = valve.model;
  Part lever(valve.name, valve.robot_from_object, valve.wheel_material);
  lever.AddCapsule(Eigen::Vector3d::Zero(), model.lever_length_m * Eigen::Vector3d::UnitX(),
                   model.tube_radius_m);
  lever.AddAt(SphereShape(model.hub_radius_m), Eigen::Vector3d::Zero());
  lever.AddCapsule(Eigen::Vector3d::Zero(), -ValveModel::kLeverStem_m * Eigen::Vector3d::UnitZ(),
                   ValveModel::kLeverStemPerHub * model.hub_radius_m);
  lever.MoveTo(scene);
}

// Where a hand goes round a drill's grip.
constexpr double kGripMiddle_m = 0.125;
constexpr double kPlate_m = 0.020;  // of the shell, between battery and grip

/// The pose of what leans with a drill's grip.
Pose LeaningPose(const DrillObject& drill) {
  return drill.robot_from_object *
         LocalPose(BodyTurn(drill.shape.body_tilt_rad), Eigen::Vector3d::Zero());
}

void AddShell(const DrillObject& drill, Scene& scene) {
  const DrillShape& shape = drill.shape;
  const double s = drill.scale;
  Part plate(drill.name, drill.robot_from_object, drill.shell_material);
  plate.AddAt(BoxShape(s * Eigen::Vector3d(shape.foot_m.x(), shape.foot_m.y(), kPlate_m)),
              s * Eigen::Vector3d(shape.foot_forward_m, 0.0, shape.foot_m.z() - 0.5 * kPlate_m));
  plate.MoveTo(scene);

  Part head(drill.name + " head", LeaningPose(drill), drill.shell_material);
  const Eigen::Vector3d back = s * Eigen::Vector3d(-shape.head_back_m, 0.0, shape.head_height_m);
  const Eigen::Vector3d front = s * Eigen::Vector3d(shape.head_front_m, 0.0, shape.head_height_m);
  const double radius = s * shape.head_radius_m;
  if (shape.kind == DrillShape::Kind::kBarrel) {
    head.AddCylinder(back, front, radius);
    head.AddAt(SphereShape(radius), back);
  } else if (shape.kind == DrillShape::Kind::kBoxHead) {
    head.AddAt(BoxShape({(front - back).x() + radius, 2.0 * radius, 2.0 * radius}),
               0.5 * (front + back) - 0.5 * radius * Eigen::Vector3d::UnitX());
  } else {
    head.AddCylinder(s * Eigen::Vector3d(0.0, 0.0, shape.head_height_m - 0.040),
                     s * Eigen::Vector3d(0.0, 0.0, shape.head_height_m), radius);
  }
  head.MoveTo(scene);
}

void AddGrip(const DrillObject& drill, Scene& scene) {
  const DrillShape& shape = drill.shape;
  const double s = drill.scale;
  const double battery_m = shape.foot_m.z() - kPlate_m;
  Part battery(drill.name + " battery", drill.robot_from_object, drill.grip_material);
  battery.AddAt(
      BoxShape(s * Eigen::Vector3d(shape.foot_m.x() - 0.002, shape.foot_m.y() - 0.002, battery_m)),
      s * Eigen::Vector3d(shape.foot_forward_m, 0.0, 0.5 * battery_m));
  battery.MoveTo(scene);

  Part grip(drill.name + " grip", LeaningPose(drill), drill.grip_material);
  const double top_m = shape.kind == DrillShape::Kind::kCutOut ? shape.head_height_m - 0.040
                                                               : shape.head_height_m - 0.013;
  for (const double side : {-0.5, 0.5}) {
    const double x = side * shape.grip_depth_m;
    grip.AddCylinder(s * Eigen::Vector3d(x, 0.0, shape.foot_m.z() - 0.007),
                     s * Eigen::Vector3d(x, 0.0, top_m), s * shape.grip_radius_m);
    if (shape.grip_depth_m == 0.0) break;
  }
  if (shape.trigger && shape.kind != DrillShape::Kind::kCutOut)
    grip.AddAt(BoxShape(s * Eigen::Vector3d(0.020, 0.016, 0.034)),
               s * Eigen::Vector3d(0.5 * shape.grip_depth_m + shape.grip_radius_m + 0.0045, 0.0,
                                   shape.head_height_m - 0.048));
  if (shape.side_handle) {
    const Eigen::Vector3d root =
        s * Eigen::Vector3d(shape.head_front_m - 0.015, shape.head_radius_m, shape.head_height_m);
    grip.AddCapsule(root, root + s * Eigen::Vector3d(0.0, 0.110, 0.0), s * 0.015);
  }
  grip.MoveTo(scene);
}

void AddChuckAndBit(const DrillObject& drill, Scene& scene) {
  constexpr double kCollar_m = 0.013;
  const DrillShape& shape = drill.shape;
  const double s = drill.scale;
  Part metal(drill.name + " chuck", LeaningPose(drill), drill.metal_material);
  if (shape.kind == DrillShape::Kind::kCutOut) {
    const Eigen::Vector3d face(0.0, 0.0, s * shape.head_height_m);
    if (shape.bit_length_m > 0.0)
      metal.AddCylinder(face, face + s * Eigen::Vector3d(0.0, 0.0, shape.bit_length_m),
                        s * shape.bit_radius_m);
    else
      metal.AddCylinder(face, face + Eigen::Vector3d(0.0, 0.0, 0.002), s * 0.010);
  } else {
    const auto at = [&](double x) -> Eigen::Vector3d {
      return s * Eigen::Vector3d(x, 0.0, shape.head_height_m);
    };
    const double collar = shape.head_front_m + kCollar_m;
    const double face = collar + shape.chuck_length_m;
    metal.AddCylinder(at(shape.head_front_m), at(collar), s * 1.3 * shape.chuck_radius_m);
    metal.AddCylinder(at(collar), at(face), s * shape.chuck_radius_m);
    if (shape.bit_length_m > 0.0)
      metal.AddCylinder(at(face), at(face + shape.bit_length_m), s * shape.bit_radius_m);
  }
  metal.MoveTo(scene);
}

}  // namespace

void AddValveBody(const ValveObject& valve, Scene& scene) {
  constexpr double kFlangeThickness_m = 0.016;
  constexpr int kBolts = 6;
  const double hub_z = valve.model.IsLever() ? 0.0 : -valve.model.dish_m;
  const double face_z = hub_z - valve.stem_length_m;
  Part body(valve.name + " body", valve.robot_from_object, valve.body_material);
  body.AddCylinder({0.0, 0.0, face_z}, {0.0, 0.0, hub_z}, valve.stem_radius_m);
  // The gland around the stem, half as long as it.
  body.AddCylinder({0.0, 0.0, face_z}, {0.0, 0.0, face_z + 0.5 * valve.stem_length_m},
                   2.0 * valve.stem_radius_m);
  body.AddCylinder({0.0, 0.0, face_z - kFlangeThickness_m}, {0.0, 0.0, face_z},
                   valve.flange_radius_m);
  for (int i = 0; i < kBolts; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kBolts;
    const Eigen::Vector3d at =
        0.8 * valve.flange_radius_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    body.AddCylinder(at + Eigen::Vector3d(0.0, 0.0, face_z),
                     at + Eigen::Vector3d(0.0, 0.0, face_z + 0.008), 0.006);
  }
  body.MoveTo(scene);
}

void AddValve(const ValveObject& valve, Scene& scene) {
  if (valve.model.IsLever())
    AddLever(valve, scene);
  else
    AddWheel(valve, scene);
  AddValveBody(valve, scene);
  scene.valves.push_back({valve.name, valve.robot_from_object, valve.model});
}

void AddDrill(const DrillObject& drill, Scene& scene) {
  AddShell(drill, scene);
  AddGrip(drill, scene);
  AddChuckAndBit(drill, scene);
  scene.drills.push_back({drill.name, drill.robot_from_object, drill.scale,
                          drill.shape.body_tilt_rad, drill.scale * kGripMiddle_m});
}

void AddBlock(const BlockObject& block, Scene& scene) {
  constexpr double kJoint_m = 0.002;
  const Eigen::Vector3d half(block.size_m.x(), 0.5 * (block.size_m.y() - kJoint_m),
                             block.size_m.z());
  const double offset_y = 0.25 * (block.size_m.y() + kJoint_m);
  Part part(block.name, block.robot_from_object, block.material);
  for (const double side : {-1.0, 1.0})
    part.AddAt(BoxShape(half), {0.0, side * offset_y, -0.5 * block.size_m.z()});
  part.MoveTo(scene);
  scene.blocks.push_back({block.name, block.robot_from_object, block.size_m});
}

void AddHandle(const HandleObject& handle, Scene& scene) {
  const HandleModel& model = handle.model;
  Part lever(handle.name, handle.robot_from_object, handle.lever_material);
  for (const HandleBar& bar : BarsOf(model)) lever.AddCapsule(bar.from, bar.to, bar.radius_m);
  lever.MoveTo(scene);
  Part plate(handle.name + " plate", handle.robot_from_object, handle.plate_material);
  const double thick_m = HandleModel::kPlateThickness_m;
  const Eigen::Vector3d middle(0.0, 0.0, 0.5 * thick_m - model.standoff_m);
  if (model.plate == HandleModel::Plate::kLong)
    plate.AddAt(BoxShape({HandleModel::kPlateWidth_m, HandleModel::kPlateLength_m, thick_m}),
                middle);
  else
    plate.AddAt(CylinderShape(HandleModel::kRosetteRadius_m, thick_m), middle);
  plate.MoveTo(scene);
  scene.handles.push_back({handle.name, handle.robot_from_object, model});
}

Rigid<frame::Robot, frame::Object> ValvePose(const Eigen::Vector3d& position_m,
                                             const Eigen::Vector3d& axis, double phase_rad) {
  const Eigen::Vector3d z = axis.normalized();
  FORESIGHT_EXPECTS(std::abs(z.z()) < 0.999, "a valve's axis is not vertical");
  const Eigen::Vector3d y = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d upright;
  upright << y.cross(z), y, z;
  return {upright * Eigen::AngleAxisd(phase_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          position_m};
}

}  // namespace foresight
