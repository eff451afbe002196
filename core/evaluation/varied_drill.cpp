#include "core/evaluation/varied_drill.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/evaluation/table_thing.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

void DrawFoot(Random& random, VariedDrill& drill) {
  switch (random.Index(3)) {
    case 0:  // a slide pack
      drill.foot_length_m = random.Uniform(0.105, 0.145);
      drill.foot_width_m = random.Uniform(0.064, 0.084);
      drill.foot_height_m = random.Uniform(0.045, 0.085);
      drill.neck_m = random.Chance(0.5) ? random.Uniform(0.008, 0.020) : 0.0;
      break;
    case 1:  // a flat one
      drill.foot_length_m = random.Uniform(0.100, 0.130);
      drill.foot_width_m = random.Uniform(0.060, 0.078);
      drill.foot_height_m = random.Uniform(0.030, 0.048);
      drill.neck_m = random.Chance(0.7) ? random.Uniform(0.010, 0.025) : 0.0;
      break;
    default:  // of a 12 V driver, whose cells are in the grip
      drill.foot_length_m = random.Uniform(0.076, 0.098);
      drill.foot_width_m = random.Uniform(0.050, 0.066);
      drill.foot_height_m = random.Uniform(0.028, 0.055);
  }
  drill.foot_forward_m = random.Uniform(-0.012, 0.024);
}

double GripLow(const VariedDrill& drill) {
  return drill.foot_height_m + drill.neck_m;
}

/// The middle of the grip at a height: on its axis, which joins its ends, or bowed out of it.
Eigen::Vector3d OnGrip(const VariedDrill& drill, double height_m) {
  const double low_m = GripLow(drill);
  const double t = std::clamp((height_m - low_m) / (drill.head_height_m - low_m), 0.0, 1.0);
  return {height_m * std::tan(drill.rake_rad) + 4.0 * drill.bow_m * t * (1.0 - t), 0.0, height_m};
}

void AddGrip(const VariedDrill& drill, TableThing& thing) {
  constexpr int kPieces = 8;
  const double low_m = GripLow(drill);
  std::vector<Eigen::Vector3d> path = {OnGrip(drill, low_m - 0.005)};
  for (int i = 1; i <= kPieces; ++i)
    path.push_back(OnGrip(drill, low_m + i * (drill.head_height_m - low_m) / kPieces));
  thing.AddGrip(drill.grip_half_m, path);
}

void AddFootAndGrip(const VariedDrill& drill, TableThing& thing) {
  const double foot_top_m = GripLow(drill);
  thing.AddBox({drill.foot_length_m, drill.foot_width_m, drill.foot_height_m},
               {drill.foot_forward_m, 0.0, 0.5 * drill.foot_height_m});
  if (drill.neck_m > 0.0)
    thing.AddBox({0.72 * drill.foot_length_m, 0.86 * drill.foot_width_m, drill.neck_m},
                 {0.5 * drill.foot_forward_m, 0.0, drill.foot_height_m + 0.5 * drill.neck_m});
  AddGrip(drill, thing);
  const double trigger_m = drill.head_height_m - drill.head_radius_m - 0.018;
  if (drill.trigger)
    thing.AddBox(
        {0.018, 0.016, 0.032},
        OnGrip(drill, trigger_m) + Eigen::Vector3d(drill.grip_half_m.x() + 0.004, 0.0, 0.0));
  if (drill.hook)
    thing.AddBox({0.016, 0.012, 0.045},
                 {drill.foot_forward_m, 0.5 * drill.foot_width_m + 0.006, foot_top_m + 0.012});
}

void AddHead(const VariedDrill& drill, TableThing& thing) {
  const double length = drill.head_back_m + drill.head_front_m;
  const double r = drill.head_radius_m;
  const Eigen::Vector3d back =
      OnGrip(drill, drill.head_height_m) - drill.head_back_m * Eigen::Vector3d::UnitX();
  thing.AddRevolved({{0.0, 0.0},
                     {r - drill.chamfer_m, 0.0},
                     {r, drill.chamfer_m},
                     {r, 0.55 * length},
                     {drill.gear_radius_m, 0.75 * length},
                     {drill.gear_radius_m, length},
                     {0.0, length}},
                    back, back + Eigen::Vector3d::UnitX(), drill.head_flattened);
  if (!drill.side_handle) return;
  const Eigen::Vector3d root(0.8 * drill.head_front_m, 0.7 * drill.gear_radius_m,
                             drill.head_height_m);
  thing.AddCylinder(0.015, root, root + Eigen::Vector3d(0.0, 0.115, 0.0));
}

void AddChuckAndBit(const VariedDrill& drill, TableThing& thing) {
  const Eigen::Vector3d root =
      OnGrip(drill, drill.head_height_m) + drill.head_front_m * Eigen::Vector3d::UnitX();
  const double face = drill.chuck_length_m;
  thing.AddRevolved({{0.0, 0.0},
                     {drill.chuck_radius_m, 0.0},
                     {drill.chuck_radius_m, 0.6 * face},
                     {drill.chuck_taper * drill.chuck_radius_m, face},
                     {0.0, face}},
                    root, root + Eigen::Vector3d::UnitX());
  if (drill.bit_length_m > 0.0)
    thing.AddCylinder(0.0035, root + face * Eigen::Vector3d::UnitX(),
                      root + (face + drill.bit_length_m) * Eigen::Vector3d::UnitX());
}

}  // namespace

VariedDrill RandomVariedDrill(Random& random) {
  VariedDrill drill;
  DrawFoot(random, drill);
  drill.grip_half_m = {random.Uniform(0.021, 0.031), random.Uniform(0.017, 0.024)};
  drill.rake_rad = RadiansFromDegrees(random.Uniform(-5.0, 18.0));
  drill.bow_m = random.Chance(0.6) ? random.Uniform(-0.008, 0.008) : 0.0;
  drill.head_radius_m = random.Uniform(0.027, 0.038);
  drill.head_height_m = random.Uniform(0.150, 0.235);
  drill.head_flattened = random.Uniform(0.8, 1.05);
  drill.gear_radius_m = drill.head_radius_m * random.Uniform(0.68, 1.0);
  drill.chamfer_m = random.Chance(0.5) ? random.Uniform(0.008, 0.022) : 0.002;
  const bool driver = random.Chance(0.3);  // short, with a socket for hexagonal bits
  drill.head_back_m = driver ? random.Uniform(0.040, 0.075) : random.Uniform(0.045, 0.105);
  drill.head_front_m = driver ? random.Uniform(0.060, 0.085) : random.Uniform(0.055, 0.105);
  drill.chuck_radius_m = driver ? random.Uniform(0.010, 0.014) : random.Uniform(0.016, 0.023);
  drill.chuck_length_m = driver ? random.Uniform(0.016, 0.028) : random.Uniform(0.030, 0.050);
  drill.chuck_taper = random.Uniform(0.6, 1.0);
  drill.bit_length_m = random.Chance(0.35) ? 0.0 : random.Uniform(0.02, 0.13);
  drill.trigger = random.Chance(0.9);
  drill.hook = random.Chance(0.25);
  drill.side_handle = !driver && random.Chance(0.1);
  return drill;
}

void AddVariedDrill(const VariedDrill& drill, const DrillMaterials& materials,
                    const Rigid<frame::Robot, frame::Object>& robot_from_place, Scene& scene) {
  TableThing grip("drill grip", robot_from_place, materials.grip);
  AddFootAndGrip(drill, grip);
  grip.MoveTo(scene);
  TableThing head("drill shell", robot_from_place, materials.shell);
  AddHead(drill, head);
  head.MoveTo(scene);
  TableThing metal("drill chuck", robot_from_place, materials.metal);
  AddChuckAndBit(drill, metal);
  metal.MoveTo(scene);
  DrillTruth truth;
  truth.name = "drill";
  truth.robot_from_object = robot_from_place;
  truth.body_tilt_rad = {0.0, drill.rake_rad};
  const double grip_high_m = drill.head_height_m - drill.head_radius_m;
  truth.grip_height_m = 0.5 * (GripLow(drill) + grip_high_m) / std::cos(drill.rake_rad);
  scene.drills.push_back(truth);
}

}  // namespace foresight
