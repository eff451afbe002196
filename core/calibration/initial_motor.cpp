#include "core/calibration/initial_motor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/calibration/locate_stand.h"
#include "core/calibration/mean_pose.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

/// Two stops that see one pose of the stand: what turned the stand in the camera's frame.
struct Turn {
  int stop_to = 0, stop_from = 0;
  Eigen::Vector3d turn_rad;  ///< rotation vector: -(A_to - A_from) times the axis
  Eigen::Matrix3d rotation;
  Eigen::Vector3d shift;
};

std::vector<Turn> TurnsOf(const std::vector<LocatedView>& views) {
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (views[i].pose != views[j].pose) continue;
      const auto moved = views[i].stand * views[j].stand.Inverse();
      turns.push_back({views[i].stop, views[j].stop, RotationLog(moved.rotation()),
                       moved.RotationMatrix(), moved.translation()});
    }
  return turns;
}

/// Direction of the motor's axis in camera: commanded angles give the sign only.
Eigen::Vector3d AxisOf(const std::vector<Turn>& turns, const std::vector<double>& stops_rad) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Turn& turn : turns) {
    const bool upwards = stops_rad[static_cast<std::size_t>(turn.stop_to)] >
                         stops_rad[static_cast<std::size_t>(turn.stop_from)];
    sum += upwards ? -turn.turn_rad : turn.turn_rad;
  }
  return sum.normalized();
}

/// Angles that explain all turns best; that of the reference is 0.
std::vector<double> AnglesOf(const std::vector<Turn>& turns, const Eigen::Vector3d& axis, int stops,
                             int reference) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(stops, stops);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(stops);
  normal(reference, reference) = 1e6;
  for (const Turn& turn : turns) {
    const double difference = -turn.turn_rad.dot(axis);
    normal(turn.stop_to, turn.stop_to) += 1.0;
    normal(turn.stop_from, turn.stop_from) += 1.0;
    normal(turn.stop_to, turn.stop_from) -= 1.0;
    normal(turn.stop_from, turn.stop_to) -= 1.0;
    right[turn.stop_to] += difference;
    right[turn.stop_from] -= difference;
  }
  const Eigen::VectorXd angles = normal.ldlt().solve(right);
  return {angles.data(), angles.data() + angles.size()};
}

/// The point of the axis next to the camera: turns leave it where it is.
Eigen::Vector3d PointOnAxis(const std::vector<Turn>& turns, const Eigen::Vector3d& axis) {
  Eigen::Matrix3d normal = axis * axis.transpose();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Turn& turn : turns) {
    const Eigen::Matrix3d moves = Eigen::Matrix3d::Identity() - turn.rotation;
    normal += moves.transpose() * moves;
    right += moves.transpose() * turn.shift;
  }
  return normal.ldlt().solve(right);
}

/// The prior turned and moved as little as puts its x axis on the one that was found.
Rigid<frame::Camera, frame::Head> OnAxis(const Rigid<frame::Camera, frame::Head>& prior,
                                         const Eigen::Vector3d& axis,
                                         const Eigen::Vector3d& point) {
  const Eigen::Vector3d prior_axis = prior.Rotate(Eigen::Vector3d::UnitX());
  return {RotationBetween(prior_axis, axis) * prior.rotation(),
          point + axis * axis.dot(prior.translation() - point)};
}

Status CheckAngles(const ChainState& state, const MotorCalibrationOptions& options) {
  for (std::size_t stop = 0; stop < state.motor_rad.size(); ++stop)
    if (!(std::abs(state.plate_rad[stop] - state.motor_rad[stop]) <= options.most_angle_error_rad))
      return Fail(ErrorCode::kInvalidInput,
                  "stop {:.6g} deg: the images say that the plate turned by {:.2f} deg. Stops and "
                  "images do not belong together, or the motor's steps are those of another head",
                  DegreesFromRadians(state.motor_rad[stop]),
                  DegreesFromRadians(state.plate_rad[stop]));
  return {};
}

Status CheckAxis(const Eigen::Vector3d& axis, const Rigid<frame::Camera, frame::Head>& prior,
                 const MotorCalibrationOptions& options) {
  const Eigen::Vector3d prior_axis = prior.Rotate(Eigen::Vector3d::UnitX());
  const double angle = std::atan2(axis.cross(prior_axis).norm(), axis.dot(prior_axis));
  if (angle <= options.most_axis_error_rad) return {};
  return Fail(ErrorCode::kInvalidInput,
              "the motor's axis is {:.0f} deg from where the CAD pose of the camera has it{}",
              DegreesFromRadians(angle),
              angle > 2.0 ? ": the motor counts the other way, or the images are mirrored"
                          : ": the camera is mounted in another way than the session says");
}

}  // namespace

int VisitCount(const CalibrationSession& session) {
  std::size_t visits = 0;
  for (const PatternPose& pose : session.poses) visits += pose.stops.size();
  return static_cast<int>(visits);
}

std::vector<CornerSet> MountCorners(const CalibrationSession& session,
                                    const std::vector<double>& stops_rad) {
  std::vector<CornerSet> all;
  int visit = 0;
  for (std::size_t pose = 0; pose < session.poses.size(); ++pose)
    for (const MotorStop& stop : session.poses[pose].stops) {
      const auto add = [&](const CalibrationBoard& board, const BoardView& view, bool on_b) {
        CornerSet corners{
            .pose = static_cast<int>(pose),
            .visit = visit,
            .stop = StopIndex(stops_rad, stop.motor_rad),
            .on_b = on_b,
            .source = NameOfStop(session.poses[pose], stop) + (on_b ? ", board B" : ", board A"),
            .on_board = {},
            .pixels = view.pixels};
        for (const int id : view.corner_ids) corners.on_board.push_back(board.Corner(id));
        all.push_back(std::move(corners));
      };
      if (stop.view.a) add(session.mount.a, *stop.view.a, false);
      if (stop.view.b) add(*session.mount.b, *stop.view.b, true);
      ++visit;
    }
  return all;
}

Result<ChainState> InitialMotor(const CalibrationSession& session, const CameraModel& camera,
                                const MotorCalibrationOptions& options,
                                std::vector<std::string>* notes) {
  ChainState state;
  state.camera = camera;
  state.camera_from_lidar = session.prior.camera_from_lidar;
  state.motor_rad = StopAngles(session);
  state.reference_stop = StopIndex(state.motor_rad, 0.0);
  state.jitter_rad.assign(static_cast<std::size_t>(VisitCount(session)), 0.0);
  FORESIGHT_TRY(std::vector<LocatedView> views, LocateStand(session, camera, notes));
  FORESIGHT_TRY(state.a_from_b, LocateBoardB(session, views, notes));
  for (LocatedView& view : views)
    view.stand = view.a ? *view.a : *view.b * state.a_from_b.Inverse();

  const std::vector<Turn> turns = TurnsOf(views);
  const Eigen::Vector3d axis = AxisOf(turns, state.motor_rad);
  if (!axis.allFinite() || axis.norm() < 0.5)
    return Fail(ErrorCode::kTooFewPoints,
                "the stand does not turn between the stops: there is no axis to be found");
  FORESIGHT_CHECK(CheckAxis(axis, session.prior.camera_from_head, options));
  state.plate_rad =
      AnglesOf(turns, axis, static_cast<int>(state.motor_rad.size()), state.reference_stop);
  state.plate_rad[static_cast<std::size_t>(state.reference_stop)] = 0.0;
  state.camera_from_head = OnAxis(session.prior.camera_from_head, axis, PointOnAxis(turns, axis));
  FORESIGHT_CHECK(CheckAngles(state, options));

  for (std::size_t pose = 0; pose < session.poses.size(); ++pose) {
    std::vector<Rigid<frame::Base, frame::Pattern>> all;
    for (const LocatedView& view : views)
      if (view.pose == static_cast<int>(pose))
        all.push_back(state.CameraFromBase(view.stop, 0.0).Inverse() * view.stand);
    if (all.empty())
      return Fail(
          ErrorCode::kTooFewPoints,
          "{}: no image of this pose shows the stand. Leave the pose out, or record it again",
          session.poses[pose].name);
    state.base_from_pattern.push_back(MeanOf(all));
  }
  return state;
}

}  // namespace foresight
