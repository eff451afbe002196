#include "core/evaluation/varied_wheel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace foresight {
namespace {

using SectionOutline = std::vector<Eigen::Vector2d>;

/// Counter-clockwise, convex.
SectionOutline OutlineOf(VariedWheel::Section kind, double width, double depth,
                         const Eigen::Vector2d& center) {
  constexpr int kArcCorners = 24;
  SectionOutline outline;
  if (kind == VariedWheel::Section::kBar) {
    const double edge = 0.15 * std::min(width, depth);
    for (const auto& [x, y] : std::array<std::pair<double, double>, 8>{{{width - edge, -depth},
                                                                        {width, -depth + edge},
                                                                        {width, depth - edge},
                                                                        {width - edge, depth},
                                                                        {-width + edge, depth},
                                                                        {-width, depth - edge},
                                                                        {-width, -depth + edge},
                                                                        {-width + edge, -depth}}})
      outline.push_back(center + Eigen::Vector2d(x, y));
    return outline;
  }
  const bool arch = kind == VariedWheel::Section::kPressed;
  const double turn = (arch ? 1.0 : 2.0) * std::numbers::pi;
  for (int i = 0; i < kArcCorners; ++i) {
    const double angle = turn * i / (arch ? kArcCorners - 1 : kArcCorners);
    const double up = arch ? 2.0 * std::sin(angle) - 1.0 : std::sin(angle);
    outline.push_back(center + Eigen::Vector2d(width * std::cos(angle), depth * up));
  }
  return outline;
}

void DrawCast(double radius_m, Random& random, VariedWheel& wheel) {
  wheel.made = "cast";
  wheel.rim_width_m = std::clamp(random.Uniform(0.055, 0.115) * radius_m, 0.005, 0.018);
  wheel.rim_depth_m = wheel.rim_width_m * random.Uniform(0.65, 1.35);
  wheel.spoke_width_m = wheel.rim_width_m * random.Uniform(0.5, 1.1);
  wheel.spoke_depth_m = wheel.spoke_width_m * random.Uniform(0.6, 1.3);
  wheel.spoke_taper = random.Uniform(0.7, 1.0);
}

void DrawPlate(double radius_m, Random& random, VariedWheel& wheel) {
  wheel.made = "plate";
  wheel.rim = wheel.spoke = VariedWheel::Section::kBar;
  wheel.rim_width_m = std::clamp(random.Uniform(0.06, 0.16) * radius_m, 0.006, 0.025);
  wheel.rim_depth_m = std::min(wheel.rim_width_m, random.Uniform(0.0025, 0.007));
  wheel.spoke_width_m = wheel.rim_width_m * random.Uniform(0.6, 1.2);
  wheel.spoke_depth_m = wheel.rim_depth_m;
  wheel.dish_m = 0.0;
}

void DrawRolled(Random& random, VariedWheel& wheel) {
  wheel.made = "rolled";
  wheel.rim = VariedWheel::Section::kBar;
  wheel.rim_width_m = random.Uniform(0.002, 0.004);
  wheel.rim_depth_m = random.Uniform(0.007, 0.020);
  const bool rods = random.Uniform() < 0.5;
  wheel.spoke = rods ? VariedWheel::Section::kOval : VariedWheel::Section::kBar;
  wheel.spoke_width_m = rods ? random.Uniform(0.005, 0.009) : random.Uniform(0.008, 0.018);
  wheel.spoke_depth_m = rods ? wheel.spoke_width_m : random.Uniform(0.002, 0.005);
}

void DrawPressed(double radius_m, Random& random, VariedWheel& wheel) {
  wheel.made = "pressed";
  wheel.rim = VariedWheel::Section::kPressed;
  wheel.spoke = VariedWheel::Section::kBar;
  wheel.rim_width_m = std::clamp(random.Uniform(0.07, 0.13) * radius_m, 0.006, 0.020);
  wheel.rim_depth_m = wheel.rim_width_m * random.Uniform(0.4, 1.0);
  wheel.spoke_width_m = wheel.rim_width_m * random.Uniform(0.7, 1.2);
  wheel.spoke_depth_m = random.Uniform(0.0015, 0.004);
  wheel.spoke_taper = random.Uniform(0.6, 1.0);
}

Shape RimOf(const VariedWheel& wheel) {
  if (wheel.rim_arc_rad >= 2.0 * std::numbers::pi)
    return RevolvedShape(
        OutlineOf(wheel.rim, wheel.rim_width_m, wheel.rim_depth_m, {wheel.radius_m, 0.0}), true);
  constexpr int kSteps = 96;
  std::vector<Eigen::Vector3d> path;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = wheel.rim_arc_rad * i / kSteps;
    path.emplace_back(wheel.radius_m * std::cos(angle), wheel.radius_m * std::sin(angle), 0.0);
  }
  return SweptShape(OutlineOf(wheel.rim, wheel.rim_width_m, wheel.rim_depth_m, {0.0, 0.0}), path,
                    Eigen::Vector3d::UnitZ());
}

}  // namespace

VariedWheel RandomVariedWheel(const ValveModel& like, Random& random) {
  VariedWheel wheel;
  wheel.radius_m = like.rim_radius_m;
  wheel.rim_arc_rad = 2.0 * std::numbers::pi;
  for (int i = 0; i < like.spokes; ++i)
    wheel.spokes_rad.push_back(2.0 * std::numbers::pi * i / like.spokes);
  wheel.dish_m = like.dish_m;
  const double kind = random.Uniform();
  if (kind < 0.35)
    DrawCast(like.rim_radius_m, random, wheel);
  else if (kind < 0.60)
    DrawPlate(like.rim_radius_m, random, wheel);
  else if (kind < 0.80)
    DrawRolled(random, wheel);
  else
    DrawPressed(like.rim_radius_m, random, wheel);
  wheel.hub_radius_m = std::max(0.014, random.Uniform(0.10, 0.28) * like.rim_radius_m);
  wheel.hub_length_m = std::max(2.0 * wheel.spoke_depth_m,
                                std::min(0.070, random.Uniform(0.6, 1.8) * wheel.hub_radius_m));
  wheel.hub_forward_m = random.Uniform(-0.4, 0.4) * wheel.hub_length_m;
  return wheel;
}

VariedWheel RandomAlmostWheel(const ValveModel& like, Random& random, std::string& what) {
  ValveModel usual = like;
  usual.spokes = std::max(3, like.spokes);
  VariedWheel wheel = RandomVariedWheel(usual, random);
  switch (random.Index(4)) {
    case 0:
      what = "a ring";
      wheel.spokes_rad.clear();
      wheel.hub_length_m = 0.0;
      break;
    case 1:
      what = "a cross without a rim";
      wheel.rim_arc_rad = 0.0;
      break;
    case 2:
      what = "a wheel that lacks a spoke";
      wheel.spokes_rad.pop_back();
      break;
    default:
      what = "half a flat wheel";
      wheel.rim_arc_rad = random.Uniform(0.40, 0.55) * 2.0 * std::numbers::pi;
      std::erase_if(wheel.spokes_rad, [&](double turn) { return turn > wheel.rim_arc_rad; });
      break;
  }
  return wheel;
}

Shape ShapeOf(const VariedWheel& wheel) {
  SceneMesh mesh;
  const auto add = [&](const Shape& shape, double z) {
    AppendShape(shape, {Eigen::Quaterniond::Identity(), {0.0, 0.0, z}}, mesh);
  };
  if (wheel.rim_arc_rad > 0.0) add(RimOf(wheel), 0.0);
  const SectionOutline spoke =
      OutlineOf(wheel.spoke, wheel.spoke_width_m, wheel.spoke_depth_m, {0.0, 0.0});
  const std::array scales = {1.0, wheel.spoke_taper};
  for (const double turn : wheel.spokes_rad) {
    const std::array path = {
        Eigen::Vector3d(0.0, 0.0, -wheel.dish_m),
        Eigen::Vector3d(wheel.radius_m * std::cos(turn), wheel.radius_m * std::sin(turn), 0.0)};
    add(SweptShape(spoke, path, Eigen::Vector3d::UnitZ(), scales), 0.0);
  }
  if (wheel.hub_length_m > 0.0)
    add(CylinderShape(wheel.hub_radius_m, wheel.hub_length_m), wheel.hub_forward_m - wheel.dish_m);
  return {std::move(mesh.vertices), std::move(mesh.triangles)};
}

void AddVariedWheel(const VariedWheel& wheel, const ValveObject& valve, Scene& scene) {
  SceneMesh mesh;
  mesh.name = valve.name;
  mesh.material = valve.wheel_material;
  mesh.robot_from_object = valve.robot_from_object;
  AppendShape(ShapeOf(wheel), valve.robot_from_object, mesh);
  scene.meshes.push_back(std::move(mesh));
}

ValveModel ModelOf(const VariedWheel& wheel) {
  ValveModel model;
  model.rim_radius_m = wheel.radius_m;
  model.tube_radius_m = wheel.rim_width_m;
  model.rim_depth_ratio = wheel.rim_depth_m / wheel.rim_width_m;
  model.spokes = static_cast<int>(wheel.spokes_rad.size());
  model.spoke_radius_m = wheel.spoke_width_m;
  model.spoke_depth_ratio = wheel.spoke_depth_m / wheel.spoke_width_m;
  model.hub_radius_m = wheel.hub_radius_m;
  model.dish_m = wheel.dish_m;
  return model;
}

}  // namespace foresight
