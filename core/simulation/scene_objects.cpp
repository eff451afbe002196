#include "core/simulation/scene_objects.h"

#include <cmath>
#include <numbers>

#include "core/base/contract.h"
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

void AddWheel(const ValveObject& valve, Scene& scene) {
  const ValveModel& model = valve.model;
  const Eigen::Vector3d hub(0.0, 0.0, -model.dish_m);
  Part wheel(valve.name, valve.robot_from_object, valve.wheel_material);
  wheel.AddAt(TorusShape(model.rim_radius_m, model.tube_radius_m), Eigen::Vector3d::Zero());
  wheel.AddAt(SphereShape(model.hub_radius_m), hub);
  if (model.spokes == 0)
    wheel.AddAt(DishShape(model.rim_radius_m, model.dish_m, 2.0 * model.spoke_radius_m),
                Eigen::Vector3d::Zero());
  for (int i = 0; i < model.spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / model.spokes;
    const Eigen::Vector3d end(model.rim_radius_m * std::cos(angle),
                              model.rim_radius_m * std::sin(angle), 0.0);
    wheel.AddCapsule(hub, end, model.spoke_radius_m);
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

}  // namespace

void AddValve(const ValveObject& valve, Scene& scene) {
  if (valve.model.IsLever())
    AddLever(valve, scene);
  else
    AddWheel(valve, scene);
  AddValveBody(valve, scene);
  scene.valves.push_back({valve.name, valve.robot_from_object, valve.model});
}

void AddDrill(const DrillObject& drill, Scene& scene) {
  // The bounds of a common 18 V drill (239 x 73 x 247 mm with battery) at scale 1.
  const double s = drill.scale;
  const auto at = [s](double x, double y, double z) -> Eigen::Vector3d {
    return s * Eigen::Vector3d(x, y, z);
  };
  Part shell(drill.name, drill.robot_from_object, drill.shell_material);
  shell.AddAt(BoxShape(at(0.117, 0.073, 0.020)), at(0.006, 0.0, 0.052));
  shell.AddCylinder(at(-0.070, 0.0, 0.208), at(0.085, 0.0, 0.208), s * 0.034);
  shell.AddAt(SphereShape(s * 0.034), at(-0.070, 0.0, 0.208));
  shell.MoveTo(scene);

  Part grip(drill.name + " grip", drill.robot_from_object, drill.grip_material);
  grip.AddAt(BoxShape(at(0.115, 0.071, 0.042)), at(0.006, 0.0, 0.021));
  grip.AddCylinder(at(0.0, 0.0, 0.055), at(0.0, 0.0, 0.195), s * 0.0255);
  grip.AddAt(BoxShape(at(0.020, 0.016, 0.034)), at(0.030, 0.0, 0.160));
  grip.MoveTo(scene);

  Part metal(drill.name + " chuck", drill.robot_from_object, drill.metal_material);
  metal.AddCylinder(at(0.085, 0.0, 0.208), at(0.098, 0.0, 0.208), s * 0.026);
  metal.AddCylinder(at(0.098, 0.0, 0.208), at(0.135, 0.0, 0.208), s * 0.020);
  metal.AddCylinder(at(0.135, 0.0, 0.208), at(0.205, 0.0, 0.208), s * 0.004);
  metal.MoveTo(scene);
  scene.drills.push_back({drill.name, drill.robot_from_object, drill.scale});
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
