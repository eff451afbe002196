#include "core/evaluation/other_tool.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/quantile.h"
#include "core/evaluation/other_world.h"
#include "core/simulation/ray_caster.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using LocalPose = Rigid<frame::Object, frame::Object>;
using Outline = std::vector<Eigen::Vector2d>;

/// Collects the parts of a tool that share a material.
class Part {
 public:
  Part(const char* name, const Material& material) {
    mesh_.name = name;
    mesh_.material = material;
  }
  Part& Add(const Shape& shape, const LocalPose& at = {}) {
    // The tool's own frame takes robot's place until the tool stands somewhere.
    AppendShape(shape, Rigid<frame::Robot, frame::Object>(at.rotation(), at.translation()), mesh_);
    return *this;
  }
  void MoveTo(OtherTool& tool) { tool.parts.push_back(std::move(mesh_)); }

 private:
  SceneMesh mesh_;
};

LocalPose At(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

/// Takes z to x: a revolved outline points forward, at a height.
LocalPose Forward(double x, double z) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY())),
          {x, 0.0, z}};
}

Outline Oval(double depth, double width) {
  Outline section;
  for (int i = 0; i < 20; ++i)
    section.emplace_back(0.5 * depth * std::cos(2.0 * std::numbers::pi * i / 20),
                         0.5 * width * std::sin(2.0 * std::numbers::pi * i / 20));
  return section;
}

/// A rectangle with broken corners.
Outline Chamfered(double depth, double width, double cut) {
  const double x = 0.5 * depth, y = 0.5 * width;
  return {{x - cut, -y}, {x, -y + cut}, {x, y - cut},   {x - cut, y},
          {-x + cut, y}, {-x, y - cut}, {-x, -y + cut}, {-x + cut, -y}};
}

/// Upright, its section's x forward: sweeps along z have x = up cross along with up = -y.
Shape Upright(const Outline& section, const std::vector<Eigen::Vector3d>& path,
              const std::vector<double>& scales = {}) {
  return SweptShape(section, path, Eigen::Vector3d::UnitY(), scales);
}

/// Where the grip is: leaning, and curved a little.
std::vector<Eigen::Vector3d> GripPath(double low_z, double high_z, double lean, double bow) {
  std::vector<Eigen::Vector3d> path;
  for (int i = 0; i <= 8; ++i) {
    const double t = i / 8.0, z = low_z + t * (high_z - low_z);
    path.emplace_back(std::tan(lean) * z + 4.0 * bow * t * (1.0 - t), 0.0, z);
  }
  return path;
}

void AddBattery(double foot_z, double depth, double width, double forward, Random& random,
                OtherTool& tool) {
  Part battery("battery", OtherMaterial(random));
  const double cut = random.Uniform(0.003, 0.015);
  const double kind = random.Uniform();
  const Eigen::Vector3d low(forward, 0.0, 0.0), high(forward, 0.0, foot_z);
  if (kind < 0.5) {  // a pack that slides on
    battery.Add(
        Upright(Chamfered(depth, width, cut), {low, high}, {1.0, random.Uniform(0.85, 1.0)}));
  } else if (kind < 0.8) {  // a flat one with a step
    const Eigen::Vector3d step(forward, 0.0, 0.6 * foot_z);
    battery.Add(Upright(Chamfered(depth, width, cut), {low, step}));
    battery.Add(Upright(Chamfered(0.75 * depth, 0.9 * width, cut), {step, high}));
  } else {  // a stick in a shoe
    battery.Add(Upright(Oval(0.85 * depth, width), {low, high}, {1.0, 0.6}));
  }
  battery.MoveTo(tool);
}

void AddGrip(const std::vector<Eigen::Vector3d>& path, double depth, double width, Random& random,
             OtherTool& tool) {
  Part grip("grip", OtherMaterial(random));
  std::vector<double> scales;
  for (std::size_t i = 0; i < path.size(); ++i)
    scales.push_back(1.0 + 0.12 * std::sin(0.9 * static_cast<double>(i)));
  grip.Add(Upright(Oval(depth, width), path, scales));
  grip.MoveTo(tool);
  tool.grip_low_m = path[path.size() / 4];
  tool.grip_high_m = path[path.size() * 3 / 4];
}

}  // namespace

OtherTool DrawDrill(Random& random) {
  OtherTool tool;
  tool.name = "drill";
  const double foot = random.Uniform(0.035, 0.075), head_z = random.Uniform(0.17, 0.24);
  const double lean = random.Uniform(-0.05, 0.22), bow = random.Uniform(-0.006, 0.006);
  const double depth = random.Uniform(0.042, 0.062), width = random.Uniform(0.038, 0.050);
  const std::vector<Eigen::Vector3d> path = GripPath(foot - 0.005, head_z, lean, bow);
  const double head_x = path.back().x();
  AddBattery(foot, random.Uniform(0.085, 0.135), random.Uniform(0.055, 0.085),
             random.Uniform(-0.01, 0.025), random, tool);
  AddGrip(path, depth, width, random, tool);

  // The body from the motor's back to the clutch, then the chuck.
  const double radius = random.Uniform(0.026, 0.042), back = random.Uniform(0.04, 0.09);
  const double gears = random.Uniform(0.05, 0.09), chuck = random.Uniform(0.016, 0.023);
  const double chuck_m = random.Uniform(0.02, 0.05), belly = random.Uniform(0.9, 1.1);
  Part body("body", OtherMaterial(random));
  const Outline outline = {{0.0, -back},          {0.7 * radius, -back}, {radius, -back + 0.02},
                           {belly * radius, 0.0}, {radius, 0.5 * gears}, {0.8 * radius, gears},
                           {0.0, gears}};
  body.Add(RevolvedShape(outline, false), Forward(head_x, head_z));
  if (random.Chance(0.3))  // a boxy motor housing
    body.Add(BoxShape({back + 0.4 * gears, 1.9 * radius, 1.9 * radius}),
             At(head_x - 0.5 * back + 0.2 * gears, 0.0, head_z));
  if (random.Chance(0.3))  // a hook
    body.Add(BoxShape({0.02, 0.006, 0.05}), At(head_x * 0.5, -0.5 * width - 0.006, 0.5 * head_z));
  body.MoveTo(tool);

  Part metal("chuck", OtherMaterial(random));
  const double tip = gears + chuck_m;
  const Outline front = {{0.0, gears - 0.002},
                         {1.25 * chuck, gears - 0.002},
                         {1.25 * chuck, gears + 0.3 * chuck_m},
                         {chuck, gears + 0.35 * chuck_m},
                         {0.6 * chuck, tip},
                         {0.0, tip}};
  metal.Add(RevolvedShape(front, false), Forward(head_x, head_z));
  if (const double bit = random.Uniform(-0.03, 0.11); bit > 0.015)
    metal.Add(CylinderShape(random.Uniform(0.002, 0.006), bit),
              Forward(head_x + tip + 0.5 * bit, head_z));
  metal.MoveTo(tool);

  Part trigger("trigger", OtherMaterial(random));
  trigger.Add(BoxShape({0.018, 0.014, random.Uniform(0.025, 0.045)}),
              At(head_x + 0.5 * depth + 0.004, 0.0, head_z - radius - 0.022));
  if (random.Chance(0.25)) {  // a guard before the fingers
    const Outline bar = Chamfered(0.014, 0.022, 0.003);
    const std::vector<Eigen::Vector3d> guard = {{0.055, 0.0, foot},
                                                {0.075, 0.0, 0.5 * (foot + head_z)},
                                                {head_x + 0.5 * gears, 0.0, head_z - 0.8 * radius}};
    trigger.Add(Upright(bar, guard));
  }
  trigger.MoveTo(tool);
  if (random.Chance(0.2)) {
    Part handle("side handle", OtherMaterial(random));
    const double side = random.Chance(0.5) ? 1.0 : -1.0;
    const Eigen::Vector3d root(head_x + gears - 0.015, side * 0.7 * radius, head_z);
    handle.Add(CapsuleShape(0.014, 0.11),
               PoseAlong(root, root + side * Eigen::Vector3d(0.0, 0.12, 0.0)));
    handle.MoveTo(tool);
  }
  return tool;
}

OtherTool DrawOtherTool(Random& random) {
  OtherTool tool;
  Part part("tool", OtherMaterial(random));
  const double depth = random.Uniform(0.035, 0.055), width = random.Uniform(0.034, 0.050);
  const double head_z = random.Uniform(0.16, 0.24);
  switch (random.Index(7)) {
    case 0: {
      tool.name = "flashlight";
      AddBattery(0.05, 0.11, 0.07, 0.01, random, tool);
      AddGrip(GripPath(0.045, head_z, 0.05, 0.0), depth, width, random, tool);
      const Outline lamp = {{0.0, -0.03}, {0.025, -0.03}, {0.03, 0.0}, {0.05, 0.06}, {0.0, 0.06}};
      part.Add(RevolvedShape(lamp, false), Forward(0.01, head_z));
      break;
    }
    case 1: {
      tool.name = "spray bottle";
      const double radius = random.Uniform(0.032, 0.045);
      const Outline bottle = {{0.0, 0.0},    {radius, 0.0},   {radius, 0.11},
                              {0.014, 0.17}, {0.014, head_z}, {0.0, head_z}};
      part.Add(RevolvedShape(bottle, false));
      part.Add(BoxShape({0.085, 0.026, 0.035}), At(0.018, 0.0, head_z + 0.012));
      part.Add(BoxShape({0.010, 0.014, 0.06}), At(0.045, 0.0, head_z - 0.03));
      AddGrip(GripPath(0.17, head_z, 0.0, 0.0), 0.028, 0.028, random, tool);
      break;
    }
    case 2: {
      tool.name = "jigsaw";
      part.Add(BoxShape({0.21, 0.07, 0.006}), At(0.0, 0.0, 0.003));
      part.Add(Upright(Chamfered(0.20, 0.065, 0.015), {{0.0, 0.0, 0.006}, {0.0, 0.0, 0.09}}));
      const Outline bar = Oval(0.035, 0.035);
      part.Add(SweptShape(
          bar,
          std::vector<Eigen::Vector3d>{
              {-0.085, 0.0, 0.08}, {-0.075, 0.0, 0.15}, {0.0, 0.0, 0.185}, {0.085, 0.0, 0.15}},
          Eigen::Vector3d::UnitY()));
      AddBattery(0.05, 0.08, 0.06, -0.13, random, tool);
      tool.grip_low_m = {0.0, 0.0, 0.09};
      tool.grip_high_m = {0.0, 0.0, 0.18};
      break;
    }
    case 3: {
      tool.name = "heat gun";
      if (random.Chance(0.5)) AddBattery(0.05, 0.11, 0.07, 0.01, random, tool);
      AddGrip(GripPath(0.0, head_z, random.Uniform(0.0, 0.2), 0.0), depth, width, random, tool);
      const double nozzle = random.Uniform(0.4, 1.0), radius = random.Uniform(0.03, 0.042);
      const Outline body = {{0.0, -0.07},
                            {radius, -0.06},
                            {radius, 0.08},
                            {nozzle * radius, 0.10},
                            {nozzle * radius, 0.16},
                            {0.0, 0.16}};
      part.Add(RevolvedShape(body, false), Forward(0.01, head_z));
      break;
    }
    case 4: {
      tool.name = "grinder on its battery";
      AddBattery(0.06, 0.09, 0.075, 0.0, random, tool);
      AddGrip(GripPath(0.05, 0.24, 0.0, 0.0), 0.058, 0.058, random, tool);
      part.Add(CylinderShape(random.Uniform(0.055, 0.065), 0.006),
               LocalPose(Eigen::Quaterniond(
                             Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitY())),
                         {0.045, 0.0, 0.26}));
      part.Add(BoxShape({0.07, 0.05, 0.05}), At(0.01, 0.0, 0.26));
      break;
    }
    case 5: {
      tool.name = "glue gun";
      AddBattery(0.012, 0.10, 0.08, 0.02, random, tool);
      AddGrip(GripPath(0.01, 0.14, -0.15, 0.0), 0.030, 0.026, random, tool);
      const Outline body = {
          {0.0, -0.02}, {0.017, -0.02}, {0.018, 0.08}, {0.005, 0.12}, {0.0, 0.12}};
      part.Add(RevolvedShape(body, false), Forward(-0.02, 0.15));
      break;
    }
    default: {
      tool.name = "radio";
      AddBattery(0.05, 0.10, 0.07, 0.0, random, tool);
      part.Add(BoxShape({random.Uniform(0.06, 0.09), random.Uniform(0.12, 0.2), 0.14}),
               At(0.0, 0.0, 0.12));
      part.Add(CylinderShape(0.004, 0.15), At(0.02, 0.05, 0.26));
      tool.grip_low_m = {0.0, 0.0, 0.05};
      tool.grip_high_m = {0.0, 0.0, 0.19};
      break;
    }
  }
  part.MoveTo(tool);
  return tool;
}

namespace {

constexpr double kStep_m = 0.003;
constexpr int kColumns = 200, kRows = 130;
constexpr double kGridFrom_m = -0.25;

/// A silhouette of a tool on the plane of x (or y) and z.
class Silhouette {
 public:
  Silhouette(const RayCaster& caster, bool from_left) {
    std::vector<SceneRay> rays;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const auto u = static_cast<float>(At(column)), z = static_cast<float>(Height(row));
        if (from_left)
          rays.push_back({{u, 2.0f, z}, -Eigen::Vector3f::UnitY()});
        else
          rays.push_back({{2.0f, u, z}, -Eigen::Vector3f::UnitX()});
      }
    std::vector<SceneHit> hits(rays.size());
    caster.Cast(rays, hits);
    for (const SceneHit& hit : hits) filled_.push_back(hit.mesh >= 0);
  }

  static double At(int column) { return kGridFrom_m + kStep_m * (column + 0.5); }
  static double Height(int row) { return kStep_m * (row + 0.5); }
  static int RowAt(double height) {
    return std::clamp(static_cast<int>(height / kStep_m), 0, kRows - 1);
  }
  static int ColumnAt(double x) {
    return std::clamp(static_cast<int>((x - kGridFrom_m) / kStep_m), 0, kColumns - 1);
  }
  bool Filled(int row, int column) const {
    return filled_[static_cast<std::size_t>(row * kColumns + column)];
  }
  /// From the first to the last column that is filled, without gaps, round one of them.
  std::pair<int, int> RunRound(int row, int column) const {
    int low = column, high = column;
    if (!Filled(row, column)) return {0, -1};
    while (low > 0 && Filled(row, low - 1)) --low;
    while (high + 1 < kColumns && Filled(row, high + 1)) ++high;
    return {low, high};
  }
  int FilledIn(int column, int low_row, int high_row) const {
    int count = 0;
    for (int row = low_row; row <= high_row; ++row) count += Filled(row, column) ? 1 : 0;
    return count;
  }

 private:
  std::vector<bool> filled_;
};

double LengthOf(const std::pair<int, int>& run) {
  return kStep_m * (run.second - run.first + 1);
}

double MedianRun(const Silhouette& view, double low_m, double high_m, double x) {
  std::vector<double> lengths;
  for (int row = Silhouette::RowAt(low_m); row <= Silhouette::RowAt(high_m); ++row)
    lengths.push_back(LengthOf(view.RunRound(row, Silhouette::ColumnAt(x))));
  return UpperMedian(std::move(lengths));
}

}  // namespace

bool ToolMeasures::IsDrill() const {
  return height_m >= 0.17 && height_m <= 0.33 && grip_m >= 0.025 && grip_m <= 0.085 &&
         grip_width_m >= 0.025 && grip_width_m <= 0.085 && foot_m >= 1.14 * grip_m &&
         head_m >= 0.11 && head_m >= 1.8 * grip_m && front_m >= 0.07 && back_m >= 0.02 &&
         nose_ratio <= 0.75;
}

ToolMeasures MeasureTool(const OtherTool& tool) {
  auto scene = std::make_shared<Scene>();
  scene->meshes = tool.parts;
  const RayCaster caster(scene);
  const Silhouette side(caster, true), front(caster, false);
  ToolMeasures measures;
  for (const SceneMesh& part : tool.parts)
    for (const Eigen::Vector3f& vertex : part.vertices)
      measures.height_m = std::max(measures.height_m, static_cast<double>(vertex.z()));
  const double h = measures.height_m;
  const auto grip_x = [&](double z) {
    const Eigen::Vector3d along = tool.grip_high_m - tool.grip_low_m;
    return tool.grip_low_m.x() + (z - tool.grip_low_m.z()) / along.z() * along.x();
  };
  measures.grip_m = MedianRun(side, 0.40 * h, 0.60 * h, grip_x(0.5 * h));
  measures.grip_width_m = MedianRun(front, 0.40 * h, 0.60 * h, 0.0);
  measures.foot_m = MedianRun(side, 0.02 * h, 0.12 * h, grip_x(0.07 * h));
  const double x = grip_x(0.85 * h);
  std::pair<int, int> head = {0, -1};
  for (int row = Silhouette::RowAt(0.68 * h); row <= Silhouette::RowAt(h); ++row)
    if (const auto run = side.RunRound(row, Silhouette::ColumnAt(x));
        LengthOf(run) > LengthOf(head))
      head = run;
  measures.head_m = LengthOf(head);
  if (head.second < head.first) return measures;
  measures.front_m = Silhouette::At(head.second) - x;
  measures.back_m = x - Silhouette::At(head.first);
  const int low_row = Silhouette::RowAt(0.62 * h), high_row = Silhouette::RowAt(h);
  const int nose = head.second - (head.second - head.first) / 10;
  const int middle = (head.first + head.second) / 2;
  measures.nose_ratio = static_cast<double>(side.FilledIn(nose, low_row, high_row)) /
                        std::max(1, side.FilledIn(middle, low_row, high_row));
  return measures;
}

}  // namespace foresight
