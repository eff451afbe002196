#include "core/evaluation/other_door_thing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/evaluation/other_world.h"
#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using LocalPose = Rigid<frame::Object, frame::Object>;
using DoorPose = Rigid<frame::Robot, frame::Object>;
using Section = std::vector<Eigen::Vector2d>;

constexpr double kPi = std::numbers::pi;

SceneMesh MeshOf(const char* name, Random& random) {
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = OtherMaterial(random);
  return mesh;
}

void Append(const Shape& shape, const LocalPose& door_from_shape, SceneMesh& mesh) {
  AppendShape(shape, DoorPose() * door_from_shape, mesh);
}

LocalPose At(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

/// Half width `a`, half depth `b`, between a diamond (power 1), an ellipse (2) and a bar (6).
Section SuperEllipse(double a, double b, double power) {
  constexpr int kCorners = 28;
  Section section;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners, c = std::cos(angle), s = std::sin(angle);
    section.emplace_back(a * std::copysign(std::pow(std::abs(c), 2.0 / power), c),
                         b * std::copysign(std::pow(std::abs(s), 2.0 / power), s));
  }
  return section;
}

/// How a bar runs: from x = from_m to to_m, an S across and a wave off the door.
struct Way {
  double from_m = 0.0, to_m = 0.12, out_m = 0.05;
  double across_m = 0.0, across_phase = 0.0, off_m = 0.0;

  Eigen::Vector3d operator()(double x) const {
    const double s = (x - from_m) / (to_m - from_m);
    return {x,
            across_m * (std::sin(kPi * s + across_phase) - std::sin(across_phase) * (1.0 - s)) * s,
            out_m + off_m * std::sin(kPi * s)};
  }
};

void AddPost(double x, double y, double out_m, Random& random, SceneMesh& mesh) {
  const double radius_m = random.Uniform(0.006, 0.014);
  const std::vector<Eigen::Vector2d> outline = {{0.0, 0.0},
                                                {random.Uniform(1.0, 2.2) * radius_m, 0.0},
                                                {radius_m, 0.3 * out_m},
                                                {random.Uniform(0.7, 1.3) * radius_m, 0.7 * out_m},
                                                {radius_m, out_m},
                                                {0.0, out_m}};
  Append(RevolvedShape(outline, false), At(x, y, 0.0), mesh);
}

/// Under the first post: round and domed, oval, or a plate with any proportions.
void AddRose(Random& random, SceneMesh& mesh) {
  const double thick_m = random.Uniform(0.003, 0.016), kind = random.Uniform();
  if (kind < 0.45) {
    const double radius_m = random.Uniform(0.018, 0.034);
    const std::vector<Eigen::Vector2d> dome = {
        {0.0, 0.0}, {radius_m, 0.0}, {0.85 * radius_m, 0.6 * thick_m}, {0.0, thick_m}};
    Append(RevolvedShape(dome, false), At(0.0, 0.0, 0.0), mesh);
  } else if (kind < 0.9) {
    const double high_m = random.Uniform(0.06, 0.30), wide_m = random.Uniform(0.025, 0.065);
    const double up_m = high_m * random.Uniform(-0.35, 0.35);
    const std::vector<Eigen::Vector3d> path = {{0.0, up_m, 0.0}, {0.0, up_m, thick_m}};
    Append(SweptShape(SuperEllipse(0.5 * wide_m, 0.5 * high_m, random.Uniform(2.0, 8.0)), path,
                      Eigen::Vector3d::UnitY()),
           LocalPose(), mesh);
  }
}

}  // namespace

DoorHardware DrawOtherBar(Random& random) {
  DoorHardware thing;
  Way way;
  const double length_m = random.Uniform(0.06, 0.20);
  const bool one_post = random.Chance(0.82);
  const double post =
      one_post && random.Chance(0.85) ? random.Uniform(0.0, 0.14) : random.Uniform(0.0, 0.5);
  way.from_m = -post * length_m;
  way.to_m = way.from_m + length_m;
  way.out_m = random.Uniform(0.032, 0.075);
  way.across_m = random.Chance(0.5) ? random.Uniform(-0.012, 0.012) : 0.0;
  way.across_phase = random.Uniform(0.0, kPi);
  way.off_m = random.Chance(0.4) ? random.Uniform(-0.010, 0.010) : 0.0;
  const double a = random.Uniform(0.007, 0.015), b = random.Uniform(0.004, 0.013);

  constexpr int kPieces = 14;
  std::vector<Eigen::Vector3d> path;
  std::vector<double> scales;
  const double thin = random.Uniform(0.6, 1.0), waist = random.Uniform(-0.2, 0.2);
  for (int i = 0; i <= kPieces; ++i) {
    const double s = static_cast<double>(i) / kPieces;
    path.push_back(way(way.from_m + s * length_m));
    scales.push_back(1.0 + (thin - 1.0) * s + waist * std::sin(2.0 * kPi * s));
  }
  SceneMesh bar = MeshOf("bar", random);
  const LocalPose turned(
      Eigen::Quaterniond(Eigen::AngleAxisd(
          (random.Chance(0.5) ? 0.0 : kPi) + RadiansFromDegrees(6.0 * random.Normal()) +
              (random.Chance(0.1) ? random.Uniform(-1.5, 1.5) : 0.0),
          Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d::Zero());
  Append(SweptShape(SuperEllipse(a, b, random.Uniform(1.6, 6.0)), path, Eigen::Vector3d::UnitZ(),
                    scales),
         turned, bar);
  // Ends that go on: back to the door, or a ball.
  const double end = random.Uniform();
  if (end < 0.25) {
    const Eigen::Vector3d tip = path.back(), down(tip.x(), tip.y(), random.Uniform(0.012, 0.028));
    Append(CapsuleShape(0.8 * std::min(a, b), (tip - down).norm()), turned * PoseAlong(tip, down),
           bar);
  } else if (end < 0.35) {
    Append(SphereShape(random.Uniform(0.009, 0.014)),
           turned * At(path.back().x(), path.back().y(), path.back().z()), bar);
  }
  SceneMesh mount = MeshOf("mount", random);
  AddRose(random, mount);
  AddPost(0.0, 0.0, way(0.0).z(), random, mount);
  if (!one_post) {
    const Eigen::Vector3d second = turned * way(way.to_m - std::max(0.0, post) * length_m);
    AddPost(second.x(), second.y(), second.z(), random, mount);
  }
  thing.parts = {std::move(bar), std::move(mount)};
  const Eigen::Vector3d pivot(0.0, 0.0, way(0.0).z());
  const Eigen::Vector3d tip = way(way.to_m);
  const double lean = std::atan2(tip.y(), tip.x());
  thing.door_from_handle =
      turned *
      LocalPose(Eigen::Quaterniond(Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitZ())), pivot);
  thing.model.length_m = tip.head<2>().norm();
  thing.model.radius_m = std::sqrt(a * b);
  thing.model.standoff_m = pivot.z();
  thing.name = one_post ? "bar on a post" : "bar on two posts";
  return thing;
}

DoorHardware DrawOtherFitting(Random& random) {
  DoorHardware thing;
  SceneMesh mesh = MeshOf("fitting", random);
  switch (random.Index(7)) {
    case 0: {
      thing.name = "oval knob";
      AddRose(random, mesh);
      const double out_m = random.Uniform(0.04, 0.07);
      AddPost(0.0, 0.0, out_m, random, mesh);
      const std::vector<Eigen::Vector3d> path = {{0.0, 0.0, out_m - 0.012},
                                                 {0.0, 0.0, out_m + 0.01}};
      Append(
          SweptShape(SuperEllipse(random.Uniform(0.024, 0.038), random.Uniform(0.015, 0.03), 2.0),
                     path, Eigen::Vector3d::UnitY()),
          LocalPose(), mesh);
      break;
    }
    case 1: {
      thing.name = "knocker";
      const double radius_m = random.Uniform(0.04, 0.07);
      Append(TorusShape(radius_m, random.Uniform(0.004, 0.008)), At(0.0, -radius_m, 0.02), mesh);
      Append(SphereShape(0.016), At(0.0, 0.0, 0.02), mesh);
      Append(CylinderShape(0.012, 0.02), At(0.0, 0.0, 0.01), mesh);
      break;
    }
    case 2:
      thing.name = "mail slot";
      Append(BoxShape({random.Uniform(0.2, 0.3), random.Uniform(0.04, 0.07), 0.012}),
             At(0.0, 0.0, 0.006), mesh);
      Append(BoxShape({0.03, 0.012, 0.02}), At(0.0, 0.0, 0.02), mesh);
      break;
    case 3:
      thing.name = "socket with its plug";
      Append(BoxShape({0.085, 0.085, 0.012}), At(0.0, 0.0, 0.006), mesh);
      Append(CylinderShape(0.02, random.Uniform(0.03, 0.05)), At(0.0, 0.0, 0.025), mesh);
      Append(CapsuleShape(0.004, 0.25), PoseAlong({0.0, 0.0, 0.04}, {0.02, -0.25, 0.015}), mesh);
      break;
    case 4:
      thing.name = "closer";
      Append(BoxShape({random.Uniform(0.18, 0.28), 0.05, random.Uniform(0.035, 0.055)}),
             At(0.0, 0.0, 0.022), mesh);
      break;
    case 5: {
      thing.name = "wheel of a safe";
      AddPost(0.0, 0.0, 0.05, random, mesh);
      const int arms = 3 + random.Index(3);
      const double arm_m = random.Uniform(0.05, 0.08);
      for (int i = 0; i < arms; ++i) {
        const double angle = 2.0 * kPi * i / arms + 0.3;
        Append(
            CapsuleShape(0.007, arm_m),
            PoseAlong({0.0, 0.0, 0.05}, {arm_m * std::cos(angle), arm_m * std::sin(angle), 0.05}),
            mesh);
      }
      break;
    }
    default: {
      thing.name = "padlock on a hasp";
      Append(BoxShape({0.11, 0.035, 0.004}), At(0.0, 0.0, 0.002), mesh);
      Append(BoxShape({0.045, 0.045, 0.022}), At(0.03, -0.045, 0.016), mesh);
      Append(TorusShape(0.016, 0.004), At(0.03, -0.02, 0.018), mesh);
      break;
    }
  }
  thing.parts = {std::move(mesh)};
  return thing;
}

}  // namespace foresight
