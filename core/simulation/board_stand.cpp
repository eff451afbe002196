#include "core/simulation/board_stand.h"

#include "core/base/contract.h"
#include "core/simulation/scene.h"

namespace foresight {
namespace {

/// Pieces a side of a warped board: flats lie 1/1024 of the bend beside the surface.
constexpr int kPieces = 32;
constexpr double kWidestMargin_m = 1.0;

using StandInRobot = Rigid<frame::Robot, frame::Pattern>;

Eigen::Vector3d MiddleOf(const CalibrationBoard& board) {
  return 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
}

void AddBoard(const std::string& name, const BoardObject& object, const StandInRobot& pose,
              Scene& scene) {
  const auto face = std::make_shared<const BoardFace>(object.board, object.errors);
  SceneMesh mesh;
  mesh.name = name;
  mesh.material = object.material;
  mesh.robot_from_object = {pose.rotation(), pose.translation()};
  mesh.face = face;
  const auto outline = face->Outline();
  const Eigen::Vector2d low = outline[0].array() - object.margin_m;
  const Eigen::Vector2d size =
      outline[2] - outline[0] + 2.0 * object.margin_m * Eigen::Vector2d::Ones();
  const bool flat = object.errors.warp == BoardWarp();
  const int pieces = flat ? 1 : kPieces;
  for (int row = 0; row <= pieces; ++row)
    for (int column = 0; column <= pieces; ++column) {
      const Eigen::Vector2d at =
          low + Eigen::Vector2d(size.x() * column / pieces, size.y() * row / pieces);
      mesh.vertices.push_back(
          (pose * Eigen::Vector3d(at.x(), at.y(), face->Depth(at))).cast<float>());
    }
  for (int row = 0; row < pieces; ++row)
    for (int column = 0; column < pieces; ++column) {
      const int first = row * (pieces + 1) + column;
      mesh.triangles.emplace_back(first, first + pieces + 1, first + 1);
      mesh.triangles.emplace_back(first + 1, first + pieces + 1, first + pieces + 2);
    }
  scene.meshes.push_back(std::move(mesh));

  BoardTruth truth{name, object.board, pose, {}};
  for (int id = 0; id < object.board.CornerCount(); ++id) truth.corners.push_back(face->Corner(id));
  scene.boards.push_back(std::move(truth));
}

}  // namespace

Status BoardObject::Check() const {
  FORESIGHT_CHECK(board.Check());
  FORESIGHT_CHECK(errors.Check(board));
  if (!(margin_m >= 0.0) || !(margin_m <= kWidestMargin_m))
    return Fail(ErrorCode::kInvalidOptions, "margin_m: {} is not within 0 to {}", margin_m,
                kWidestMargin_m);
  return {};
}

BoardMount BoardStand::Mount() const {
  BoardMount mount{.a = a.board, .b = {}, .a_from_b = a_from_b};
  if (b) mount.b = b->board;
  return mount;
}

StandInRobot StandPose(const BoardStand& stand, const Eigen::Vector3d& position_m,
                       const Eigen::Quaterniond& rotation) {
  Eigen::Vector3d middle = MiddleOf(stand.a.board);
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  if (stand.b) {
    middle = 0.5 * (middle + stand.a_from_b * MiddleOf(stand.b->board));
    ahead += stand.a_from_b.Rotate(Eigen::Vector3d::UnitZ());
  }
  // Two boards back to back have no front.
  ahead = ahead.norm() > 0.1 ? Eigen::Vector3d(ahead.normalized()) : Eigen::Vector3d::UnitZ();
  Eigen::Vector3d down = Eigen::Vector3d::UnitY() - ahead.y() * ahead;
  if (down.norm() < 0.1) down = Eigen::Vector3d::UnitX() - ahead.x() * ahead;
  down.normalize();
  Eigen::Matrix3d stand_from_upright;  // x ahead, y left, z up, as robot
  stand_from_upright << ahead, ahead.cross(down), -down;
  const Eigen::Quaterniond turn = rotation * Eigen::Quaterniond(stand_from_upright.transpose());
  return {turn, position_m - turn * middle};
}

void AddStand(const BoardStand& stand, const StandInRobot& robot_from_stand, Scene& scene) {
  AddBoard(stand.name, stand.a, robot_from_stand, scene);
  if (stand.b) AddBoard(stand.name + " b", *stand.b, robot_from_stand * stand.a_from_b, scene);
}

Scene AtPlace(const Scene& scene, int place) {
  FORESIGHT_EXPECTS(place >= 0 && place <= static_cast<int>(scene.places.size()),
                    "one of the scene's places");
  Scene at_place = scene;
  if (place == 0) return at_place;
  const StandPlace& there = scene.places[static_cast<std::size_t>(place - 1)];
  AddStand(scene.stands[static_cast<std::size_t>(there.stand)], there.robot_from_stand, at_place);
  return at_place;
}

}  // namespace foresight
