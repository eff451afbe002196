#include "core/calibration/locate_stand.h"

#include <algorithm>
#include <limits>

#include "core/calibration/locate_board.h"
#include "core/calibration/mean_pose.h"
#include "core/calibration/misfit_limit.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// A board with too few corners is left out with a note; one that is mirrored is an error.
Result<std::optional<LocatedBoard>> Locate(const CameraModel& camera, const CalibrationBoard& board,
                                           const std::optional<BoardView>& view,
                                           const std::string& source,
                                           std::vector<std::string>* notes) {
  if (!view) return std::nullopt;
  const auto located = LocateBoard(camera, board, *view, source);
  if (located) return *located;
  if (located.error().code != ErrorCode::kTooFewPoints) return tl::unexpected(located.error());
  notes->push_back(located.error().message);
  return std::nullopt;
}

struct Difference {
  double turn_rad = 0.0;
  double shift_m = 0.0;
  bool Within(double most_turn_rad, double most_shift_m) const {
    return turn_rad <= most_turn_rad && shift_m <= most_shift_m;
  }
};

template <class To, class From>
Difference DifferenceOf(const Rigid<To, From>& a, const Rigid<To, From>& b) {
  const auto step = StepBetween(a, b);
  return {step.template head<3>().norm(), step.template tail<3>().norm()};
}

/// Of all, the one that lies closest to the others.
BoardFromBoard MedianOf(const std::vector<BoardFromBoard>& all) {
  BoardFromBoard best = all.front();
  double best_sum = std::numeric_limits<double>::infinity();
  for (const auto& candidate : all) {
    double sum = 0.0;
    for (const auto& other : all) {
      const Difference difference = DifferenceOf(candidate, other);
      sum += difference.turn_rad + difference.shift_m;
    }
    if (sum < best_sum) best = candidate, best_sum = sum;
  }
  return best;
}

constexpr double kMostStandTurn_rad = 0.14;  // 8 deg; boards are located to a fraction of a degree
constexpr double kMostStandShift_m = 0.060;

/// @pre the image shows both boards
BoardFromBoard BetweenBoards(const LocatedView& view) {
  return view.a->Inverse() * *view.b;
}

/// Of each image that shows both boards.
std::vector<BoardFromBoard> BetweenAllBoards(const std::vector<LocatedView>& views) {
  std::vector<BoardFromBoard> all;
  for (const LocatedView& view : views)
    if (view.a && view.b) all.push_back(BetweenBoards(view));
  return all;
}

/// Why an image cannot be of the stand; empty = it can.
std::string MisfitOf(const LocatedView& view, double most_rms_px,
                     const std::optional<BoardFromBoard>& usual) {
  for (const auto& [name, located, rms_px] : {std::tuple("A", view.a.has_value(), view.rms_a_px),
                                              std::tuple("B", view.b.has_value(), view.rms_b_px)})
    if (located && rms_px > most_rms_px)
      return fmt::format("the corners taken for board {} do not lie in a plane ({:.1f} px)", name,
                         rms_px);
  if (!usual || !view.a || !view.b) return {};
  const Difference difference = DifferenceOf(*usual, BetweenBoards(view));
  if (difference.Within(kMostStandTurn_rad, kMostStandShift_m)) return {};
  return fmt::format(
      "board B is {:.1f} deg and {:.0f} mm from where the other images have it: the "
      "boards are exchanged, or one grid was found across both",
      DegreesFromRadians(difference.turn_rad), 1000.0 * difference.shift_m);
}

CameraFromStand StandOf(const LocatedView& view, const BoardFromBoard& a_from_b) {
  return view.a ? *view.a : *view.b * a_from_b.Inverse();
}

/// Whether the stand turned between two images of a pose as far as the motor was told to.
bool TurnsAsCommanded(const LocatedView& view, const LocatedView& other,
                      const BoardFromBoard& a_from_b, const std::vector<double>& stops_rad) {
  constexpr double kMost_rad = 0.07;  // 4 deg: a board is located to one, a motor turns to two
  const auto moved = StandOf(view, a_from_b) * StandOf(other, a_from_b).Inverse();
  const double commanded_rad = std::abs(stops_rad[static_cast<std::size_t>(view.stop)] -
                                        stops_rad[static_cast<std::size_t>(other.stop)]);
  return std::abs(RotationLog(moved.rotation()).norm() - commanded_rad) <= kMost_rad;
}

/// Whether most of the other images of its pose say that an image shows something else.
bool TurnsUnlikeItsPose(const LocatedView& view, const std::vector<LocatedView>& views,
                        const BoardFromBoard& a_from_b, const std::vector<double>& stops_rad) {
  int others = 0, agree = 0;
  for (const LocatedView& other : views) {
    if (other.pose != view.pose || &other == &view) continue;
    ++others;
    agree += TurnsAsCommanded(view, other, a_from_b, stops_rad) ? 1 : 0;
  }
  return others >= 2 && 2 * agree < others;
}

std::vector<double> RmsOfBoards(const std::vector<LocatedView>& views) {
  std::vector<double> all;
  for (const LocatedView& view : views) {
    if (view.a) all.push_back(view.rms_a_px);
    if (view.b) all.push_back(view.rms_b_px);
  }
  return all;
}

}  // namespace

std::string NameOfStop(const PatternPose& pose, const MotorStop& stop) {
  const std::string image = stop.view.source.empty() ? "" : stop.view.source + ", ";
  return fmt::format("{}{}, stop {:.6g} deg", image, pose.name, DegreesFromRadians(stop.motor_rad));
}

Result<std::vector<LocatedView>> LocateStand(const CalibrationSession& session,
                                             const CameraModel& camera,
                                             std::vector<std::string>* notes) {
  const std::vector<double> stops_rad = StopAngles(session);
  std::vector<LocatedView> views;
  for (std::size_t pose = 0; pose < session.poses.size(); ++pose)
    for (std::size_t i = 0; i < session.poses[pose].stops.size(); ++i) {
      const MotorStop& stop = session.poses[pose].stops[i];
      if (stop.view.empty()) continue;
      LocatedView view;
      view.source = NameOfStop(session.poses[pose], stop);
      view.pose = static_cast<int>(pose);
      view.stop = StopIndex(stops_rad, stop.motor_rad);
      view.capture = static_cast<int>(i);
      const auto locate = [&](const CalibrationBoard& board, const std::optional<BoardView>& seen,
                              const char* name, std::optional<CameraFromStand>* pose_of,
                              double* rms_px) -> Status {
        FORESIGHT_TRY(const auto located,
                      Locate(camera, board, seen, view.source + ", board " + name, notes));
        if (!located) return {};
        *pose_of = located->camera_from_board;
        *rms_px = located->rms_px;
        return {};
      };
      FORESIGHT_CHECK(locate(session.mount.a, stop.view.a, "A", &view.a, &view.rms_a_px));
      if (session.mount.b)
        FORESIGHT_CHECK(locate(*session.mount.b, stop.view.b, "B", &view.b, &view.rms_b_px));
      if (view.a || view.b) views.push_back(std::move(view));
    }
  return views;
}

/// Fails where the boards of an image do not stand as those of the others, or as drawn.
Result<BoardFromBoard> LocateBoardB(const CalibrationSession& session,
                                    const std::vector<LocatedView>& views,
                                    std::vector<std::string>* notes) {
  const BoardFromBoard& drawn = session.mount.a_from_b;
  const std::vector<BoardFromBoard> all = BetweenAllBoards(views);
  if (all.empty()) {
    if (session.mount.b)
      notes->push_back("no image shows both boards of the stand: board B starts as drawn");
    return drawn;
  }
  const BoardFromBoard median = MedianOf(all);
  const Difference from_drawing = DifferenceOf(drawn, median);
  if (!from_drawing.Within(kMostStandTurn_rad, kMostStandShift_m)) {
    const bool exchanged =
        DifferenceOf(drawn, median.Inverse()).Within(kMostStandTurn_rad, kMostStandShift_m);
    return Fail(ErrorCode::kInvalidInput,
                "board B of the stand is {:.1f} deg and {:.0f} mm from where the session says: {}",
                DegreesFromRadians(from_drawing.turn_rad), 1000.0 * from_drawing.shift_m,
                exchanged ? "boards A and B are exchanged"
                          : "boards A and B may be exchanged, or the drawing is of another stand");
  }
  for (const LocatedView& view : views) {
    if (!view.a || !view.b) continue;
    const Difference difference = DifferenceOf(median, BetweenBoards(view));
    if (!difference.Within(kMostStandTurn_rad, kMostStandShift_m))
      return Fail(ErrorCode::kInvalidInput,
                  "{}: board B is {:.1f} deg and {:.0f} mm from where the other images have it: "
                  "boards A and B are exchanged in this image, or a board moved",
                  view.source, DegreesFromRadians(difference.turn_rad),
                  1000.0 * difference.shift_m);
  }
  return MeanOf(all);
}

Result<CalibrationSession> WithoutMisfits(CalibrationSession session, const CameraModel& camera,
                                          std::vector<std::string>* notes) {
  std::vector<std::string> later;  // LocateStand's are given when the motor is located
  FORESIGHT_TRY(const std::vector<LocatedView> views, LocateStand(session, camera, &later));
  const std::vector<BoardFromBoard> both = BetweenAllBoards(views);
  std::optional<BoardFromBoard> usual;
  if (!both.empty()) usual = MedianOf(both);
  const double most_rms_px = MisfitLimit(MedianRms(RmsOfBoards(views)));
  const std::vector<double> stops_rad = StopAngles(session);
  constexpr std::size_t kOneIn = 5;
  std::vector<std::string> reasons;
  CalibrationSession kept = session;
  for (const LocatedView& view : views) {
    std::string misfit = MisfitOf(view, most_rms_px, usual);
    if (misfit.empty() &&
        TurnsUnlikeItsPose(view, views, usual.value_or(session.mount.a_from_b), stops_rad))
      misfit =
          "the other images of this place have the stand turned otherwise: one board was "
          "taken for the other, or the stand moved";
    if (misfit.empty()) continue;
    reasons.push_back(fmt::format("{}: left out: {}", view.source, misfit));
    kept.poses[static_cast<std::size_t>(view.pose)]
        .stops[static_cast<std::size_t>(view.capture)]
        .view = {};
  }
  if (kOneIn * reasons.size() > views.size()) return session;
  notes->insert(notes->end(), reasons.begin(), reasons.end());
  return kept;
}

}  // namespace foresight
