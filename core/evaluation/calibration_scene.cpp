#include "core/evaluation/calibration_scene.h"

#include <fmt/format.h>

namespace foresight {
namespace {

/// 7 by 6 m, and high enough for a stand above the head.
constexpr const char* kRoom = R"(ambient: 0.35
lights:
  - {position_m: [-0.4, 0.9, 2.0], intensity: 0.25}
  - {position_m: [-0.4, -0.9, 1.2], intensity: 0.2}
materials:
  print: {color: [0.85, 0.85, 0.85], color2: [0.04, 0.04, 0.04], lidar_reflectance: 0.7}
  wall: {color: [0.42, 0.40, 0.36], color2: [0.34, 0.33, 0.31], pattern: noise, pattern_size_m: 0.7, lidar_reflectance: 0.6}
solids:
  - {shape: box, name: front wall, size_m: [0.1, 7, 5], position_m: [4.1, 0, 2], material: wall}
  - {shape: box, name: back wall, size_m: [0.1, 7, 5], position_m: [-2.1, 0, 2], material: wall}
  - {shape: box, name: left wall, size_m: [7, 0.1, 5], position_m: [1, 3, 2], material: wall}
  - {shape: box, name: right wall, size_m: [7, 0.1, 5], position_m: [1, -3, 2], material: wall}
  - {shape: box, name: floor, size_m: [7, 7, 0.1], position_m: [1, 0, -0.05], material: wall}
  - {shape: box, name: ceiling, size_m: [7, 7, 0.1], position_m: [1, 0, 4], material: wall}
)";

template <class To, class From>
std::string PoseYaml(const Rigid<To, From>& pose) {
  const Eigen::Quaterniond& q = pose.rotation();
  const Eigen::Vector3d& t = pose.translation();
  return fmt::format(
      "{{quaternion_wxyz: [{:.9f}, {:.9f}, {:.9f}, {:.9f}], translation_m: [{:.6f}, "
      "{:.6f}, {:.6f}]}}",
      q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

}  // namespace

void MarkBoards(BoardMount* mount) {
  mount->a.kind = CalibrationBoard::Kind::kCharuco;
  mount->a.dictionary = CalibrationBoard::Dictionary::k4x4_50;
  if (!mount->b) return;
  mount->b->kind = CalibrationBoard::Kind::kCharuco;
  mount->b->dictionary = CalibrationBoard::Dictionary::k5x5_50;
}

std::string CalibrationSceneYaml(const SimulatedCalibration& made) {
  const CalibrationSession& session = made.session;
  std::string yaml = "foresight_scene: 1\nname: calibration\n";
  yaml += kRoom;
  yaml += fmt::format("stands:\n  - {{name: board, a: \"{}\", material: print}}\n",
                      ToText(session.intrinsic_board));
  yaml += fmt::format("  - {{name: mount, a: \"{}\", material: print", ToText(session.mount.a));
  if (session.mount.b)
    yaml +=
        fmt::format(", b: \"{}\", a_from_b: {}", ToText(*session.mount.b), PoseYaml(made.a_from_b));
  yaml += "}\nplaces:\n";
  const auto robot_from_camera =
      (made.truth.CameraFromBase(0.0) * made.truth.robot_from_base.Inverse()).Inverse();
  for (std::size_t i = 0; i < made.camera_from_view.size(); ++i)
    yaml += fmt::format("  - {{stand: board, name: view {}, robot_from_stand: {}}}\n", i + 1,
                        PoseYaml(robot_from_camera * made.camera_from_view[i]));
  for (std::size_t i = 0; i < made.base_from_pattern.size(); ++i)
    yaml +=
        fmt::format("  - {{stand: mount, name: {}, robot_from_stand: {}}}\n", session.poses[i].name,
                    PoseYaml(made.truth.robot_from_base * made.base_from_pattern[i]));
  return yaml;
}

}  // namespace foresight
