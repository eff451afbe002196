#include "core/evaluation/door_hardware.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using LocalPose = Rigid<frame::Object, frame::Object>;
using DoorPose =
    Rigid<frame::Robot, frame::Object>;  // the identity: a mesh is drawn in its own frame

constexpr double kPi = std::numbers::pi;

LocalPose At(const Eigen::Vector3d& position) {
  return {Eigen::Quaterniond::Identity(), position};
}

LocalPose Turned(double angle_rad, const Eigen::Vector3d& position) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ())), position};
}

/// One mesh of solids, each placed in a frame that is turned on the door.
class Builder {
 public:
  Builder(const char* name, const Material& material,
          const LocalPose& door_from_local = LocalPose())
      : door_from_local_(door_from_local) {
    mesh_.name = name;
    mesh_.material = material;
  }

  void Add(const Shape& shape, const LocalPose& local_from_shape = LocalPose()) {
    AppendShape(shape, DoorPose() * (door_from_local_ * local_from_shape), mesh_);
  }
  void Bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m) {
    Add(CapsuleShape(radius_m, (to - from).norm()), PoseAlong(from, to));
  }
  void Box(const Eigen::Vector3d& size, const Eigen::Vector3d& middle) {
    Add(BoxShape(size), At(middle));
  }
  /// A cylinder along z.
  void Disc(double radius_m, double from_z, double to_z, double x = 0.0, double y = 0.0) {
    Add(CylinderShape(radius_m, to_z - from_z), At({x, y, 0.5 * (from_z + to_z)}));
  }
  void MoveTo(std::vector<SceneMesh>& meshes) { meshes.push_back(std::move(mesh_)); }

 private:
  LocalPose door_from_local_;
  SceneMesh mesh_;
};

std::vector<Eigen::Vector2d> OvalSection(double width_m, double depth_m) {
  constexpr int kCorners = 20;
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners;
    section.emplace_back(0.5 * width_m * std::cos(angle), 0.5 * depth_m * std::sin(angle));
  }
  return section;
}

std::vector<Eigen::Vector2d> FlatSection(double width_m, double depth_m) {
  const double x = 0.5 * width_m, y = 0.5 * depth_m, cut = 0.2 * std::min(x, y);
  return {{x, -y + cut}, {x, y - cut},   {x - cut, y},   {-x + cut, y},
          {-x, y - cut}, {-x, -y + cut}, {-x + cut, -y}, {x - cut, -y}};
}

/// The way that a lever's middle line takes in its own frame, from what lies behind the pivot to
/// the end.
std::vector<Eigen::Vector3d> DrawnPath(const HandleModel& model) {
  constexpr int kPieces = 10;
  std::vector<Eigen::Vector3d> path;
  if (model.behind_m > 0.0) path.emplace_back(-model.behind_m, 0.0, model.standoff_m);
  for (int i = 0; i <= kPieces; ++i) {
    const double s = static_cast<double>(i) / kPieces;
    path.emplace_back(s * model.length_m, model.bow_m * HandleModel::BowAt(s),
                      model.standoff_m + model.lift_m * std::sin(kPi * s));
  }
  return path;
}

struct LeverDrawing {
  double width_m = 0.020, depth_m = 0.020;
  bool round = true, flat = false;
  double bow_m = 0.0, lift_m = 0.0, taper = 1.0;
};

LeverDrawing DrawSection(Random& random) {
  LeverDrawing drawing;
  const double kind = random.Uniform();
  drawing.round = kind < 0.45;
  drawing.flat = kind >= 0.75;
  if (drawing.round) {
    drawing.width_m = drawing.depth_m = random.Uniform(0.016, 0.024);
  } else {
    drawing.width_m = random.Uniform(0.016, 0.028);
    drawing.depth_m = random.Uniform(0.008, 0.016);
  }
  if (random.Chance(0.4)) drawing.bow_m = random.Uniform(-0.014, 0.014);
  if (random.Chance(0.25)) drawing.lift_m = random.Uniform(-0.008, 0.012);
  if (random.Chance(0.3)) drawing.taper = random.Uniform(0.65, 1.1);
  return drawing;
}

/// Most levers end at their pivot; some go on for a little, a few for much of their length.
double DrawBehind(double length_m, Random& random) {
  const double kind = random.Uniform();
  if (kind < 0.6) return 0.0;
  if (kind < 0.85) return random.Uniform(0.004, 0.030);
  return random.Uniform(0.030, 0.6 * length_m);
}

void AddLeverBody(const HandleModel& model, const LeverDrawing& drawing, Builder& body) {
  const auto path = DrawnPath(model);
  if (drawing.round && drawing.taper == 1.0) {
    for (std::size_t i = 1; i < path.size(); ++i) body.Bar(path[i - 1], path[i], model.radius_m);
  } else {
    const auto section = drawing.flat ? FlatSection(drawing.width_m, drawing.depth_m)
                                      : OvalSection(drawing.width_m, drawing.depth_m);
    std::vector<double> scales;
    for (std::size_t i = 0; i < path.size(); ++i)
      scales.push_back(1.0 + (drawing.taper - 1.0) * static_cast<double>(i) /
                                 static_cast<double>(path.size() - 1));
    // The section's x lies along y of the lever, its y off the door.
    body.Add(SweptShape(section, path, Eigen::Vector3d::UnitZ(), scales));
  }
  const double end_radius_m = 0.5 * std::min(drawing.width_m, drawing.depth_m) * drawing.taper;
  if (!drawing.round)
    body.Add(CapsuleShape(end_radius_m, drawing.width_m - 2.0 * end_radius_m),
             PoseAlong(path.back() - Eigen::Vector3d(0.0, 1e-3, 0.0),
                       path.back() + Eigen::Vector3d(0.0, 1e-3, 0.0)));
  if (model.returned)
    body.Bar(path.back(), {model.length_m, 0.0, HandleModel::kReturnGap_m + end_radius_m},
             end_radius_m);
}

/// A lock's rose or a thumb turn below or above, as doors have.
void AddLock(double below_m, const Material& material, Random& random, DoorHardware& hardware) {
  Builder lock("lock", material);
  if (random.Chance(0.6)) {
    lock.Disc(random.Uniform(0.024, 0.028), 0.0, random.Uniform(0.006, 0.012), 0.0, -below_m);
    if (random.Chance(0.5)) lock.Disc(0.0085, 0.0, random.Uniform(0.010, 0.020), 0.0, -below_m);
  } else {
    lock.Box({0.034, 0.065, 0.010}, {0.0, -below_m, 0.005});
  }
  if (random.Chance(0.2)) lock.Box({0.004, 0.022, 0.030}, {0.0, -below_m, 0.028});  // a key
  lock.MoveTo(hardware.beside);
}

/// On the door, under what stands on it.
void AddPlate(HandleModel::Plate plate, Random& random, Builder& body) {
  const double thick_m = random.Uniform(0.005, 0.012);
  if (plate == HandleModel::Plate::kLong) {
    const double length_m = random.Uniform(0.17, 0.26), width_m = random.Uniform(0.032, 0.050);
    const double above_m = length_m * random.Uniform(0.22, 0.5);
    body.Box({width_m, length_m, thick_m}, {0.0, above_m - 0.5 * length_m, 0.5 * thick_m});
  } else if (random.Chance(0.7)) {
    body.Disc(random.Uniform(0.022, 0.029), 0.0, thick_m);
  } else {
    const double side_m = random.Uniform(0.046, 0.056);
    body.Box({side_m, side_m, thick_m}, {0.0, 0.0, 0.5 * thick_m});
  }
}

void AddNeck(const HandleModel& model, Random& random, Builder& body) {
  body.Disc(random.Uniform(0.7, 1.1) * std::max(model.radius_m, 0.008), 0.0, model.standoff_m);
}

// ---- what is no lever handle

void AddKnob(Random& random, Builder& body) {
  const double radius_m = random.Uniform(0.020, 0.033), out_m = random.Uniform(0.040, 0.065);
  AddPlate(HandleModel::Plate::kRosette, random, body);
  body.Disc(0.4 * radius_m, 0.0, out_m);
  if (random.Chance(0.5))
    body.Add(SphereShape(radius_m), At({0.0, 0.0, out_m}));
  else
    body.Disc(radius_m, out_m - 0.5 * radius_m, out_m + 0.5 * radius_m);
}

/// Posts at both ends or nearer to the middle, bare or on rosettes.
void AddPullBar(Random& random, Builder& body) {
  const double length_m = random.Uniform(0.09, 0.45), out_m = random.Uniform(0.030, 0.075);
  const double radius_m = random.Uniform(0.005, 0.015);
  const double over_m = random.Chance(0.5) ? 0.0 : random.Uniform(0.05, 0.30) * length_m;
  const Eigen::Vector3d end(0.5 * length_m, 0.0, out_m), post(0.5 * length_m - over_m, 0.0, out_m);
  const Eigen::Vector3d mirror(-1.0, 1.0, 1.0), foot(1.0, 1.0, 0.0);
  body.Bar(-end.x() * Eigen::Vector3d::UnitX() + Eigen::Vector3d(0.0, 0.0, out_m), end, radius_m);
  body.Bar(post, post.cwiseProduct(foot), radius_m);
  body.Bar(post.cwiseProduct(mirror), post.cwiseProduct(mirror).cwiseProduct(foot), radius_m);
  if (!random.Chance(0.35)) return;
  const double rosette_m = random.Uniform(0.018, 0.029), thick_m = random.Uniform(0.004, 0.011);
  for (const double side : {-1.0, 1.0}) body.Disc(rosette_m, 0.0, thick_m, side * post.x());
}

/// One post in the middle, as pulls of lockers have.
void AddBarOnPost(Random& random, Builder& body) {
  const double half_m = 0.5 * random.Uniform(0.08, 0.20), out_m = random.Uniform(0.030, 0.070);
  const double radius_m = random.Uniform(0.005, 0.013);
  if (random.Chance(0.5)) AddPlate(HandleModel::Plate::kRosette, random, body);
  body.Bar({-half_m, 0.0, out_m}, {half_m, 0.0, out_m}, radius_m);
  body.Disc(random.Uniform(0.7, 1.2) * radius_m, 0.0, out_m);
}

/// A bent rod.
void AddBow(Random& random, Builder& body) {
  const double half_m = 0.5 * random.Uniform(0.09, 0.22), out_m = random.Uniform(0.030, 0.055);
  const double radius_m = random.Uniform(0.004, 0.010);
  constexpr int kPieces = 16;
  const auto at = [&](int i) {
    const double angle = kPi * i / kPieces;
    return Eigen::Vector3d(half_m * std::cos(angle), 0.0, out_m * std::sqrt(std::sin(angle)));
  };
  for (int i = 0; i < kPieces; ++i) body.Bar(at(i), at(i + 1), radius_m);
}

void AddThumbTurn(Random& random, Builder& body) {
  AddPlate(HandleModel::Plate::kRosette, random, body);
  const double length_m = random.Uniform(0.025, 0.05), out_m = random.Uniform(0.022, 0.035);
  body.Box({length_m, 0.010, out_m}, {0.0, 0.0, 0.5 * out_m});
}

/// Sags between clips a little off the door.
void AddCable(Random& random, Builder& body) {
  constexpr int kPieces = 24;
  const double radius_m = random.Uniform(0.003, 0.009), off_m = random.Uniform(0.008, 0.045);
  const double sag_m = random.Uniform(0.0, 0.12), half_m = random.Uniform(0.08, 0.9);
  const auto at = [&](int i) {
    const double s = 2.0 * i / kPieces - 1.0;
    return Eigen::Vector3d(s * half_m, sag_m * (s * s - 0.3),
                           off_m * (1.0 + 0.3 * std::cos(9.0 * s)) + radius_m);
  };
  for (int i = 0; i < kPieces; ++i) body.Bar(at(i), at(i + 1), radius_m);
}

/// A shelf's bracket: one arm on the door, one that stands out, a brace.
void AddBracket(Random& random, Builder& body) {
  const double arm_m = random.Uniform(0.08, 0.20), out_m = random.Uniform(0.06, 0.18);
  const double width_m = random.Uniform(0.018, 0.032), thick_m = random.Uniform(0.003, 0.006);
  body.Box({arm_m, width_m, thick_m}, {0.5 * arm_m, 0.0, 0.5 * thick_m});
  body.Box({thick_m, width_m, out_m}, {0.0, 0.0, 0.5 * out_m});
  if (random.Chance(0.6)) body.Bar({0.75 * arm_m, 0.0, 0.0}, {0.0, 0.0, 0.75 * out_m}, 0.006);
}

void AddSwitchBox(Random& random, Builder& body) {
  const double width_m = random.Uniform(0.07, 0.16), high_m = random.Uniform(0.07, 0.16);
  const double out_m = random.Uniform(0.012, 0.065);
  body.Box({width_m, high_m, out_m}, {0.0, 0.0, 0.5 * out_m});
  if (random.Chance(0.6)) body.Box({0.5 * width_m, 0.6 * high_m, 0.006}, {0.0, 0.0, out_m + 0.002});
}

void AddPipe(Random& random, Builder& body) {
  const double radius_m = random.Uniform(0.007, 0.03), off_m = random.Uniform(0.0, 0.04);
  const double z = radius_m + off_m;
  body.Bar({-1.2, 0.0, z}, {1.2, 0.0, z}, radius_m);
  for (const double x : {-0.35, 0.02, 0.4}) {
    const double at = x + random.Uniform(-0.1, 0.1);
    body.Box({0.02, 2.0 * radius_m + 0.008, z + radius_m}, {at, 0.0, 0.5 * (z + radius_m)});
  }
}

/// A coat's hook: out, and up at its end.
void AddHook(Random& random, Builder& body) {
  const double out_m = random.Uniform(0.03, 0.07), up_m = random.Uniform(0.01, 0.05);
  const double radius_m = random.Uniform(0.004, 0.008);
  body.Box({0.02, random.Uniform(0.04, 0.09), 0.004}, {0.0, 0.0, 0.002});
  body.Bar({0.0, 0.0, 0.0}, {0.0, -0.01, out_m}, radius_m);
  body.Bar({0.0, -0.01, out_m}, {0.0, up_m, out_m}, radius_m);
  body.Add(SphereShape(1.6 * radius_m), At({0.0, up_m, out_m}));
}

/// A hinge's knuckle with its leaves.
void AddHinge(Random& random, Builder& body) {
  const double length_m = random.Uniform(0.07, 0.14), radius_m = random.Uniform(0.007, 0.013);
  body.Bar({-0.5 * length_m, 0.0, 0.6 * radius_m}, {0.5 * length_m, 0.0, 0.6 * radius_m}, radius_m);
  body.Box({length_m, 0.07, 0.003}, {0.0, 0.0, 0.0015});
}

/// A bolt that slides in two guides, with a knob.
void AddBolt(Random& random, Builder& body) {
  const double length_m = random.Uniform(0.09, 0.20), radius_m = random.Uniform(0.005, 0.009);
  const double z = 0.004 + radius_m;
  body.Box({0.8 * length_m, 0.045, 0.004}, {0.0, 0.0, 0.002});
  body.Bar({-0.5 * length_m, 0.0, z}, {0.5 * length_m, 0.0, z}, radius_m);
  for (const double x : {-0.28, 0.28})
    body.Box({0.02, 0.045, z + radius_m + 0.003},
             {x * length_m, 0.0, 0.5 * (z + radius_m + 0.003)});
  body.Bar({0.0, 0.0, z}, {0.0, 0.0, z + random.Uniform(0.015, 0.035)}, 0.005);
}

/// A lock and its plate alone, as where the lever came off.
void AddBareLock(Random& random, Builder& body) {
  AddPlate(random.Chance(0.5) ? HandleModel::Plate::kLong : HandleModel::Plate::kRosette, random,
           body);
  if (random.Chance(0.5)) body.Disc(0.009, 0.0, random.Uniform(0.010, 0.030));
}

struct Thing {
  const char* name;
  void (*add)(Random&, Builder&);
};
constexpr std::array kThings = {
    Thing{"knob", AddKnob},
    Thing{"pull bar", AddPullBar},
    Thing{"pull bar", AddPullBar},
    Thing{"bow", AddBow},
    Thing{"bar on a post", AddBarOnPost},
    Thing{"thumb turn", AddThumbTurn},
    Thing{"cable", AddCable},
    Thing{"bracket", AddBracket},
    Thing{"switch box", AddSwitchBox},
    Thing{"pipe", AddPipe},
    Thing{"hook", AddHook},
    Thing{"hinge", AddHinge},
    Thing{"bolt", AddBolt},
    Thing{"bare lock", AddBareLock},
};

}  // namespace

DoorHardware DrawLever(Random& random, const Material& material, const Material& other) {
  DoorHardware hardware;
  hardware.name = "lever";
  const LeverDrawing drawing = DrawSection(random);
  HandleModel& model = hardware.model;
  model.length_m =
      random.Chance(0.85) ? random.Uniform(0.095, 0.145) : random.Uniform(0.085, 0.165);
  model.radius_m = 0.5 * std::sqrt(drawing.width_m * drawing.depth_m);
  model.bow_m = drawing.bow_m;
  model.lift_m = drawing.lift_m;
  model.standoff_m = random.Uniform(0.040, 0.068);
  model.returned = random.Chance(0.35);
  model.plate = random.Chance(0.35) ? HandleModel::Plate::kLong : HandleModel::Plate::kRosette;
  model.behind_m = DrawBehind(model.length_m, random);
  const double side = random.Chance(0.5) ? 0.0 : kPi;
  double lean = RadiansFromDegrees(4.0 * random.Normal());
  if (random.Chance(0.125)) lean = RadiansFromDegrees(random.Uniform(-90.0, 90.0));
  hardware.door_from_handle = Turned(side + lean, {0.0, 0.0, model.standoff_m});

  Builder lever("lever", material, Turned(side + lean, Eigen::Vector3d::Zero()));
  AddLeverBody(model, drawing, lever);
  lever.MoveTo(hardware.parts);
  Builder plate("plate", random.Chance(0.7) ? material : other);
  AddPlate(model.plate, random, plate);
  AddNeck(model, random, plate);
  plate.MoveTo(hardware.parts);
  if (random.Chance(model.plate == HandleModel::Plate::kLong ? 0.2 : 0.6))
    AddLock(random.Uniform(0.062, 0.095), other, random, hardware);
  return hardware;
}

DoorHardware DrawOtherDoorThing(Random& random, const Material& material, const Material& other) {
  DoorHardware hardware;
  const Thing& thing =
      kThings[static_cast<std::size_t>(random.Index(static_cast<int>(kThings.size())))];
  hardware.name = thing.name;
  const double turns[] = {0.0, 0.5 * kPi, random.Uniform(-kPi, kPi)};
  Builder body(thing.name, material,
               Turned(turns[random.Index(3)] + RadiansFromDegrees(3.0 * random.Normal()),
                      Eigen::Vector3d::Zero()));
  thing.add(random, body);
  body.MoveTo(hardware.parts);
  if (random.Chance(0.3)) AddLock(random.Uniform(0.062, 0.095), other, random, hardware);
  return hardware;
}

Rigid<frame::Robot, frame::Object> DoorFacing(const Eigen::Vector3d& position, double yaw_rad,
                                              double lean_rad) {
  const Eigen::Vector3d z(-std::cos(yaw_rad) * std::cos(lean_rad),
                          -std::sin(yaw_rad) * std::cos(lean_rad), std::sin(lean_rad));
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d::UnitZ().cross(z).normalized();
  axes.col(1) = z.cross(axes.col(0));
  axes.col(2) = z;
  return {axes, position};
}

void Hang(std::vector<SceneMesh> parts, const Rigid<frame::Robot, frame::Object>& robot_from_door,
          Scene& scene) {
  for (SceneMesh& part : parts) {
    for (Eigen::Vector3f& vertex : part.vertices)
      vertex = (robot_from_door * vertex.cast<double>()).cast<float>();
    part.robot_from_object = robot_from_door;
    scene.meshes.push_back(std::move(part));
  }
}

}  // namespace foresight
