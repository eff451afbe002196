#include "core/evaluation/table_tools.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/evaluation/table_thing.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();
const Eigen::Vector3d kForward = Eigen::Vector3d::UnitX();

void AddTriggerSprayer(TableThing& thing, Random& random) {
  const double radius = random.Uniform(0.028, 0.050), shoulder = random.Uniform(0.11, 0.18);
  const double neck = random.Uniform(0.012, 0.018),
               neck_top = shoulder + random.Uniform(0.03, 0.06);
  thing.AddRevolved({{0.0, 0.0},
                     {0.95 * radius, 0.0},
                     {radius, 0.012},
                     {radius * random.Uniform(0.8, 1.0), 0.6 * shoulder},
                     {0.92 * radius, shoulder},
                     {neck, neck_top},
                     {neck, neck_top + 0.02},
                     {0.0, neck_top + 0.02}},
                    kOrigin, kUp, random.Uniform(0.6, 1.0));
  const double length = random.Uniform(0.065, 0.090), height = random.Uniform(0.022, 0.042);
  const Eigen::Vector3d head(random.Uniform(0.005, 0.020), 0.0, neck_top + 0.02 + 0.5 * height);
  thing.AddBox({length, random.Uniform(0.022, 0.034), height}, head);
  const Eigen::Vector3d nozzle = head + 0.5 * length * kForward;
  thing.AddCylinder(random.Uniform(0.008, 0.012), nozzle, nozzle + 0.015 * kForward);
  const Eigen::Vector3d pivot = head + Eigen::Vector3d(0.3 * length, 0.0, -0.4 * height);
  thing.AddCylinder(0.005, pivot, pivot + Eigen::Vector3d(random.Uniform(0.0, 0.02), 0.0, -0.045));
}

void AddFlashlight(TableThing& thing, Random& random) {
  const double grip = random.Uniform(0.013, 0.024), lamp = grip * random.Uniform(1.3, 2.2);
  const double height = random.Uniform(0.14, 0.28);
  if (random.Chance(0.5)) {  // straight, on its lamp or on its end
    const double flare = random.Uniform(0.03, 0.06);
    if (random.Chance(0.5))
      thing.AddRevolved({{0.0, 0.0},
                         {lamp, 0.0},
                         {lamp, 0.025},
                         {grip, 0.025 + flare},
                         {grip, height},
                         {0.0, height}},
                        kOrigin, kUp);
    else
      thing.AddRevolved({{0.0, 0.0},
                         {grip, 0.0},
                         {grip, height - 0.025 - flare},
                         {lamp, height - 0.025},
                         {lamp, height},
                         {0.0, height}},
                        kOrigin, kUp);
    return;
  }
  thing.AddRevolved({{0.0, 0.0}, {1.3 * grip, 0.0}, {grip, 0.02}, {grip, height}, {0.0, height}},
                    kOrigin, kUp);
  const Eigen::Vector3d back = height * kUp - 1.1 * grip * kForward;
  const double reach = grip + random.Uniform(0.03, 0.05);
  thing.AddRevolved(
      {{0.0, 0.0}, {1.1 * grip, 0.0}, {1.1 * grip, grip}, {lamp, reach}, {0.0, reach}}, back,
      back + kForward);
}

/// An oval grip from a foot's top to a height.
void AddUprightGrip(double from_m, double to_m, double rake_rad, Random& random,
                    TableThing& thing) {
  const std::array path = {Eigen::Vector3d(from_m * std::tan(rake_rad), 0.0, from_m),
                           Eigen::Vector3d(to_m * std::tan(rake_rad), 0.0, to_m)};
  thing.AddGrip({random.Uniform(0.017, 0.027), random.Uniform(0.014, 0.023)}, path);
}

void AddWorkLight(TableThing& thing, Random& random) {
  const double foot = random.Uniform(0.035, 0.075), height = random.Uniform(0.17, 0.23);
  thing.AddBox({random.Uniform(0.09, 0.13), random.Uniform(0.06, 0.08), foot},
               {random.Uniform(-0.01, 0.02), 0.0, 0.5 * foot});
  AddUprightGrip(foot - 0.004, height, RadiansFromDegrees(random.Uniform(-10.0, 10.0)), random,
                 thing);
  const double radius = random.Uniform(0.028, 0.045), lamp = radius * random.Uniform(1.0, 1.4);
  const double back = random.Uniform(0.03, 0.06), front = random.Uniform(0.04, 0.08);
  const Eigen::Vector3d from = height * kUp - back * kForward;
  thing.AddRevolved({{0.0, 0.0},
                     {0.8 * radius, 0.0},
                     {radius, 0.02},
                     {radius, 0.7 * (back + front)},
                     {lamp, back + front},
                     {0.0, back + front}},
                    from, from + kForward);
}

void AddJug(TableThing& thing, Random& random) {
  const double belly = random.Uniform(0.045, 0.070), height = random.Uniform(0.16, 0.26);
  const double neck = belly * random.Uniform(0.5, 0.85);
  thing.AddRevolved({{0.0, 0.0},
                     {0.8 * belly, 0.0},
                     {belly, 0.35 * height},
                     {neck, 0.8 * height},
                     {1.1 * neck, height},
                     {0.0, height}},
                    kOrigin, kUp);
  const double reach = random.Uniform(0.035, 0.055);
  const std::array handle = {Eigen::Vector3d(-0.9 * neck, 0.0, 0.85 * height),
                             Eigen::Vector3d(-neck - reach, 0.0, 0.80 * height),
                             Eigen::Vector3d(-belly - reach, 0.0, 0.45 * height),
                             Eigen::Vector3d(-0.9 * belly, 0.0, 0.22 * height)};
  for (std::size_t i = 0; i + 1 < handle.size(); ++i)
    thing.AddCylinder(0.008, handle[i], handle[i + 1]);
  const Eigen::Vector3d lip(0.8 * neck, 0.0, random.Uniform(0.75, 0.93) * height);
  if (random.Chance(0.7))
    thing.AddCylinder(random.Uniform(0.010, 0.018), lip,
                      lip + Eigen::Vector3d(random.Uniform(0.03, 0.06), 0.0, 0.03));
}

/// A hair dryer that stays wide to its mouth, or a heat gun with a tube. One whose tube is as
/// narrow as a chuck has no foot: it is no drill.
void AddHotAirTool(TableThing& thing, Random& random) {
  const bool dryer = random.Chance(0.5);
  const double height = random.Uniform(0.17, 0.23);
  const double radius = dryer ? random.Uniform(0.035, 0.048) : random.Uniform(0.026, 0.036);
  const double foot = random.Chance(0.5) ? random.Uniform(0.03, 0.07) : 0.0;
  if (foot > 0.0)
    thing.AddBox({random.Uniform(0.08, 0.12), random.Uniform(0.05, 0.075), foot},
                 {0.0, 0.0, 0.5 * foot});
  AddUprightGrip(std::max(0.0, foot - 0.004), height,
                 RadiansFromDegrees(random.Uniform(-12.0, 15.0)), random, thing);
  const double back = random.Uniform(0.03, 0.07), front = random.Uniform(0.11, 0.16);
  const double length = back + front;
  const double tube = dryer ? random.Uniform(0.35, 0.45) * length : random.Uniform(0.03, 0.07);
  const double mouth =
      radius * (dryer || foot > 0.0 ? random.Uniform(0.96, 1.1) : random.Uniform(0.45, 1.0));
  constexpr double kNarrowing_m = 0.015;  // from the barrel to a heat gun's tube
  const Eigen::Vector3d from = height * kUp - back * kForward;
  thing.AddRevolved({{0.0, 0.0},
                     {0.7 * radius, 0.0},
                     {radius, 0.5 * back},
                     {radius, length - tube - (dryer ? 0.0 : kNarrowing_m)},
                     {mouth, dryer ? length - 0.001 : length - tube},
                     {mouth, length},
                     {0.0, length}},
                    from, from + kForward);
}

void AddGrinder(TableThing& thing, Random& random) {
  const double body = random.Uniform(0.026, 0.036), length = random.Uniform(0.20, 0.28);
  const double disc = random.Uniform(0.055, 0.065), gear = random.Uniform(0.045, 0.06);
  if (random.Chance(0.5)) {  // on its disc
    const double axis_height = gear - 0.3 * body;
    thing.AddCylinder(disc, {0.0, 0.0, 0.002}, {0.0, 0.0, 0.008});
    thing.AddCylinder(0.9 * body, {0.0, 0.0, 0.006}, {0.0, 0.0, gear});
    const Eigen::Vector3d from(-0.5 * body, 0.0, axis_height);
    thing.AddRevolved({{0.0, 0.0},
                       {0.9 * body, 0.0},
                       {body, 0.4 * length},
                       {0.8 * body, 0.6 * length},
                       {1.1 * body, length},
                       {0.0, length}},
                      from, from - kForward);
    return;
  }
  thing.AddRevolved({{0.0, 0.0},
                     {1.15 * body, 0.0},
                     {1.1 * body, 0.3 * length},
                     {0.85 * body, 0.5 * length},
                     {body, length},
                     {0.0, length}},
                    kOrigin, kUp);
  const Eigen::Vector3d gear_end = (length - 0.9 * body) * kUp + gear * kForward;
  thing.AddCylinder(0.85 * body, (length - 0.9 * body) * kUp, gear_end);
  thing.AddCylinder(disc, gear_end, gear_end + 0.006 * kForward);
}

}  // namespace

std::span<const TableTool> TableTools() {
  using enum TableTool;
  static constexpr std::array kAll = {kTriggerSprayer, kFlashlight, kWorkLight, kJug,
                                      kHotAirTool,     kGrinder};
  return kAll;
}

const char* NameOf(TableTool tool) {
  switch (tool) {
    case TableTool::kTriggerSprayer:
      return "trigger sprayer";
    case TableTool::kFlashlight:
      return "torch";
    case TableTool::kWorkLight:
      return "work light on a grip";
    case TableTool::kJug:
      return "jug";
    case TableTool::kHotAirTool:
      return "hot air tool";
    case TableTool::kGrinder:
      return "angle grinder";
  }
  return "";
}

void AddTableTool(TableTool tool, const Rigid<frame::Robot, frame::Object>& robot_from_place,
                  const Material& material, Random& random, Scene& scene) {
  TableThing thing(NameOf(tool), robot_from_place, material);
  switch (tool) {
    case TableTool::kTriggerSprayer:
      AddTriggerSprayer(thing, random);
      break;
    case TableTool::kFlashlight:
      AddFlashlight(thing, random);
      break;
    case TableTool::kWorkLight:
      AddWorkLight(thing, random);
      break;
    case TableTool::kJug:
      AddJug(thing, random);
      break;
    case TableTool::kHotAirTool:
      AddHotAirTool(thing, random);
      break;
    case TableTool::kGrinder:
      AddGrinder(thing, random);
      break;
  }
  thing.MoveTo(scene);
}

}  // namespace foresight
