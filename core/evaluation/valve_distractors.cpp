#include "core/evaluation/valve_distractors.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/simulation/shapes.h"

namespace foresight {
namespace {

using LocalPose = Rigid<frame::Object, frame::Object>;

constexpr std::array kAll = {Distractor::kEmptyRegion,  Distractor::kEmptyWall,
                             Distractor::kBox,          Distractor::kBall,
                             Distractor::kPipe,         Distractor::kHalfWheel,
                             Distractor::kCableCoil,    Distractor::kTableEdge,
                             Distractor::kBicycleWheel, Distractor::kSquareFrame};

/// Builds one mesh of solids in the object's frame.
class Builder {
 public:
  Builder(const char* name, const DistractorPlace& place, const Material& material)
      : place_(place) {
    mesh_.name = name;
    mesh_.material = material;
    mesh_.robot_from_object = place.robot_from_object;
  }

  void Add(const Shape& shape, const LocalPose& object_from_shape) {
    AppendShape(shape, place_.robot_from_object * object_from_shape, mesh_);
  }
  void Bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
    Add(CapsuleShape(radius, (to - from).norm()), PoseAlong(from, to));
  }
  void Box(const Eigen::Vector3d& size, const Eigen::Vector3d& center) {
    Add(BoxShape(size), {Eigen::Quaterniond::Identity(), center});
  }
  /// From the pivot of a wheel back into the wall.
  void Stem() { Bar(Eigen::Vector3d::Zero(), {0.0, 0.0, -place_.wall_m}, 0.011); }
  void MoveTo(Scene& scene) { scene.meshes.push_back(std::move(mesh_)); }

 private:
  const DistractorPlace& place_;
  SceneMesh mesh_;
};

Eigen::Vector3d OnCircle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle), 0.0};
}

void AddHalfWheel(const DistractorPlace& place, Random& random, Builder& builder) {
  constexpr int kChords = 24;
  const double arc = random.Uniform(0.40, 0.55) * 2.0 * std::numbers::pi;
  const double begin = random.Uniform(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < kChords; ++i)
    builder.Bar(OnCircle(place.radius_m, begin + arc * i / kChords),
                OnCircle(place.radius_m, begin + arc * (i + 1) / kChords), 0.012);
  for (const double fraction : {0.15, 0.85})
    builder.Bar(Eigen::Vector3d::Zero(), OnCircle(place.radius_m, begin + fraction * arc), 0.009);
  builder.Stem();
}

void AddCableCoil(const DistractorPlace& place, Random& random, Builder& builder) {
  const int turns = 3 + random.Index(4);
  for (int i = 0; i < turns; ++i) {
    const Eigen::Vector3d off(random.Uniform(-0.012, 0.012), random.Uniform(-0.012, 0.012),
                              random.Uniform(-0.03, 0.0));
    const Eigen::Quaterniond tilt(
        Eigen::AngleAxisd(random.Uniform(0.0, 0.08), Eigen::Vector3d::UnitX()));
    builder.Add(TorusShape(place.radius_m * random.Uniform(0.93, 1.05), 0.007), {tilt, off});
  }
}

void AddBicycleWheel(const DistractorPlace& place, Random& random, Builder& builder) {
  const double radius = std::max(place.radius_m, 0.17);
  builder.Add(TorusShape(radius, 0.018), LocalPose());
  const int spokes = 12 + random.Index(9);
  for (int i = 0; i < spokes; ++i)
    builder.Bar({0.0, 0.0, i % 2 == 0 ? 0.03 : -0.03},
                OnCircle(radius, 2.0 * std::numbers::pi * i / spokes), 0.0015);
  builder.Bar({0.0, 0.0, 0.05}, {0.0, 0.0, -0.05}, 0.018);
}

void AddSquareFrame(const DistractorPlace& place, Builder& builder) {
  const double half = 0.9 * place.radius_m;
  const std::array<Eigen::Vector3d, 4> corners = {
      Eigen::Vector3d(half, half, 0), {-half, half, 0}, {-half, -half, 0}, {half, -half, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    builder.Bar(corners[i], corners[(i + 1) % 4], 0.012);
    builder.Bar(Eigen::Vector3d::Zero(), 0.5 * (corners[i] + corners[(i + 1) % 4]), 0.009);
  }
  builder.Stem();
}

void Build(Distractor thing, const DistractorPlace& place, Random& random, Builder& builder) {
  const double radius = place.radius_m;
  switch (thing) {
    case Distractor::kEmptyRegion:
    case Distractor::kEmptyWall:
      return;
    case Distractor::kBox:
      return builder.Box({2.0 * radius, random.Uniform(1.0, 2.0) * radius, place.wall_m},
                         {0.0, 0.0, -0.5 * place.wall_m});
    case Distractor::kBall:
      return builder.Add(SphereShape(0.8 * radius), LocalPose());
    case Distractor::kPipe: {
      const double angle = random.Uniform(0.0, std::numbers::pi);
      return builder.Bar(OnCircle(2.0, angle), OnCircle(-2.0, angle), random.Uniform(0.015, 0.05));
    }
    case Distractor::kHalfWheel:
      return AddHalfWheel(place, random, builder);
    case Distractor::kCableCoil:
      return AddCableCoil(place, random, builder);
    case Distractor::kTableEdge:
      return builder.Box({0.9 * radius, 3.0, 0.04}, {-0.45 * radius, 0.0, -0.1});
    case Distractor::kBicycleWheel:
      return AddBicycleWheel(place, random, builder);
    case Distractor::kSquareFrame:
      return AddSquareFrame(place, builder);
  }
}

}  // namespace

std::span<const Distractor> Distractors() {
  return kAll;
}

const char* NameOf(Distractor thing) {
  switch (thing) {
    case Distractor::kEmptyRegion:
      return "an empty region";
    case Distractor::kEmptyWall:
      return "an empty wall";
    case Distractor::kBox:
      return "a box";
    case Distractor::kBall:
      return "a ball";
    case Distractor::kPipe:
      return "a pipe";
    case Distractor::kHalfWheel:
      return "half a wheel";
    case Distractor::kCableCoil:
      return "a coil of cable";
    case Distractor::kTableEdge:
      return "a table's edge";
    case Distractor::kBicycleWheel:
      return "a bicycle's wheel";
    case Distractor::kSquareFrame:
      return "a square frame";
  }
  return "nothing";
}

void AddDistractor(Distractor thing, const DistractorPlace& place, const Material& material,
                   Random& random, Scene& scene) {
  Builder builder(NameOf(thing), place, material);
  Build(thing, place, random, builder);
  builder.MoveTo(scene);
}

}  // namespace foresight
