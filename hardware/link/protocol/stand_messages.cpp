#include "hardware/link/protocol/stand_messages.h"

#include <cmath>

namespace foresight {
namespace {

constexpr int kMostPlaces = 1000;

Result<CalibrationBoard> BoardFrom(const char* what, const std::string& text) {
  auto board = CalibrationBoardFromText(text);
  if (!board)
    return Fail(ErrorCode::kBadData, "the head's stand: {}: {}", what, board.error().message);
  return board;
}

Result<BoardFromBoard> PoseFrom(const link::StandReply& message) {
  if (message.a_from_b_size() != 7)
    return Fail(ErrorCode::kBadData, "the head's stand: a_from_b has {} numbers, not 7",
                message.a_from_b_size());
  const auto value = [&](int i) { return message.a_from_b(i); };
  const Eigen::Quaterniond rotation(value(3), value(4), value(5), value(6));
  const Eigen::Vector3d translation(value(0), value(1), value(2));
  if (!translation.allFinite() || !(std::abs(rotation.norm() - 1.0) < 1e-6))
    return Fail(ErrorCode::kBadData, "the head's stand: a_from_b is no pose");
  return BoardFromBoard(rotation, translation);
}

}  // namespace

link::StandReply ToMessage(const MovingStand& stand) {
  link::StandReply message;
  const BoardMount& mount = stand.Mount();
  message.set_board_a(ToText(mount.a));
  if (mount.b) message.set_board_b(ToText(*mount.b));
  const Eigen::Vector3d& t = mount.a_from_b.translation();
  const Eigen::Quaterniond& q = mount.a_from_b.rotation();
  for (const double value : {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()})
    message.add_a_from_b(value);
  message.set_single_board(ToText(stand.SingleBoard()));
  for (const MovingStand::Place& place : stand.Places()) {
    link::PlaceOfStand& there = *message.add_places();
    there.set_name(place.name);
    there.set_mount(place.mount);
  }
  message.set_at(stand.At() + 1);
  return message;
}

Result<StandDescription> FromMessage(const link::StandReply& message) {
  if (message.places_size() > kMostPlaces || message.at() < 0 ||
      message.at() > message.places_size())
    return Fail(ErrorCode::kBadData, "the head's stand: place {} of {}", message.at(),
                message.places_size());
  StandDescription stand;
  FORESIGHT_TRY(stand.mount.a, BoardFrom("board A", message.board_a()));
  if (!message.board_b().empty()) {
    FORESIGHT_TRY(stand.mount.b, BoardFrom("board B", message.board_b()));
  }
  FORESIGHT_TRY(stand.mount.a_from_b, PoseFrom(message));
  FORESIGHT_CHECK(stand.mount.Check());
  FORESIGHT_TRY(stand.single_board, BoardFrom("the single board", message.single_board()));
  for (const link::PlaceOfStand& place : message.places())
    stand.places.push_back({place.name(), place.mount()});
  stand.at = message.at() - 1;
  return stand;
}

}  // namespace foresight
