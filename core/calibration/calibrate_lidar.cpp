#include "core/calibration/calibrate_lidar.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/calibration/tangent.h"
#include "core/geometry/nearest_rotation.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

int CountReturns(const std::vector<BoardHits>& all) {
  std::size_t count = 0;
  for (const BoardHits& hits : all) count += hits.returns.size();
  return static_cast<int>(count);
}

Rigid<frame::Camera, frame::Pattern> CameraFromBoard(const ChainState& state,
                                                     const BoardHits& hits) {
  const double jitter =
      hits.visit == BoardHits::kNone ? 0.0 : state.jitter_rad[static_cast<std::size_t>(hits.visit)];
  const auto camera_from_stand = state.CameraFromBase(hits.stop, jitter) *
                                 state.base_from_pattern[static_cast<std::size_t>(hits.pose)];
  return hits.on_b ? camera_from_stand * state.a_from_b : camera_from_stand;
}

/// The pose of the lidar without a start: n . (r1 x + r2 y + t) = n . o is linear in the first two
/// columns of the rotation and the translation. nullopt where the returns do not lie in the lidar's
/// plane, or leave a direction open.
std::optional<Rigid<frame::Camera, frame::Lidar>> LinearPose(const ChainState& state,
                                                             const std::vector<BoardHits>& all) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> right = Eigen::Matrix<double, 9, 1>::Zero();
  Eigen::Matrix3d normal_t = Eigen::Matrix3d::Zero();
  struct Row {
    Eigen::Vector3d n, point;
    double offset;
  };
  std::vector<Row> rows;
  for (const BoardHits& hits : all) {
    const auto camera_from_board = CameraFromBoard(state, hits);
    const Eigen::Vector3d n = camera_from_board.Rotate(Eigen::Vector3d::UnitZ());
    for (const LidarReturn& r : hits.returns) {
      if (std::abs(r.direction.z()) > 1e-9) return std::nullopt;
      const Eigen::Vector3d p = (r.range_m + state.range_offset_m) * r.direction;
      const double offset = n.dot(camera_from_board.translation());
      Eigen::Matrix<double, 9, 1> row;
      row << n * p.x(), n * p.y(), n;
      normal += row * row.transpose();
      right += row * offset;
      normal_t += n * n.transpose();
      rows.push_back({n, p, offset});
    }
  }
  const Eigen::VectorXd spread = EigenOf(normal).values;
  if (spread[0] < 1e-9 * spread[8]) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> x = normal.ldlt().solve(right);
  Eigen::Matrix3d near;
  near << x.segment<3>(0), x.segment<3>(3), x.segment<3>(0).cross(x.segment<3>(3));
  if (near.determinant() < 0.0) return std::nullopt;
  const Eigen::Matrix3d rotation = NearestRotation(near);
  Eigen::Vector3d right_t = Eigen::Vector3d::Zero();
  for (const Row& row : rows) right_t += row.n * (row.offset - row.n.dot(rotation * row.point));
  return Rigid<frame::Camera, frame::Lidar>(rotation,
                                            Eigen::Vector3d(normal_t.ldlt().solve(right_t)));
}

void Measure(const ChainData& data, LidarCalibration* result) {
  double range = 0.0, plane = 0.0;
  for (const BoardHits& hits : data.hits) {
    const auto lidar_from_board =
        result->state.camera_from_lidar.Inverse() * CameraFromBoard(result->state, hits);
    const Eigen::Vector3d n = lidar_from_board.Rotate(Eigen::Vector3d::UnitZ());
    const std::vector<double> residuals = RangeResiduals(data, result->state, hits);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const double distance = residuals[i] * n.dot(hits.returns[i].direction);
      range += residuals[i] * residuals[i];
      plane += distance * distance;
    }
  }
  result->returns = CountReturns(data.hits);
  result->range_rms_m = std::sqrt(range / result->returns);
  result->plane_rms_m = std::sqrt(plane / result->returns);
}

constexpr int kLeastReturns = 60;
constexpr int kLeastLines = 6;  // each gives 2 of the 6 degrees of freedom; half of them by chance

Status CheckEnough(const std::vector<BoardHits>& hits) {
  const int returns = CountReturns(hits);
  if (returns >= kLeastReturns && static_cast<int>(hits.size()) >= kLeastLines) return {};
  return Fail(
      ErrorCode::kTooFewPoints,
      "camera and lidar: {} lines with {} returns lie on the boards, at least {} lines with "
      "{} are needed. Record more poses of the stand, hinge turned and tilted, or correct "
      "the lidar's CAD pose: it may be 5 deg and 100 mm off",
      hits.size(), returns, kLeastLines, kLeastReturns);
}

/// How long the motor turned upwards and downwards, in seconds.
struct Directions {
  double up_s = 0.0;
  double down_s = 0.0;
};

Directions DirectionsOf(const std::vector<MotorTrack>& tracks) {
  constexpr double kSlow_rad_s = 0.05;  // 3 deg/s
  Directions directions;
  for (const MotorTrack& track : tracks) {
    const auto samples = track.samples();
    // Steps of the encoder hide the speed between two samples.
    constexpr std::size_t kApart = 10;
    for (std::size_t i = kApart; i < samples.size(); ++i) {
      const double speed = (samples[i].angle_rad - samples[i - kApart].angle_rad) /
                           (samples[i].time_s - samples[i - kApart].time_s);
      const double step_s = samples[i].time_s - samples[i - 1].time_s;
      if (speed > kSlow_rad_s) directions.up_s += step_s;
      if (speed < -kSlow_rad_s) directions.down_s += step_s;
    }
  }
  return directions;
}

constexpr double kLeastRatio = 0.2;  // of the way back in a sweep up and down

Status CheckBothWays(const Directions& directions) {
  const double all = directions.up_s + directions.down_s;
  if (all <= 0.0)
    return Fail(ErrorCode::kInvalidInput,
                "time: the motor does not turn during the sweep. Sweep up and down in front of the "
                "stand, at 50 deg/s or more");
  if (std::min(directions.up_s, directions.down_s) >= kLeastRatio * all) return {};
  return Fail(
      ErrorCode::kInvalidInput,
      "time: the sweep goes {} only ({:.1f} s up, {:.1f} s down). One way an offset in time "
      "is the same as a turn of the lidar about the motor's axis, and no residual shows the "
      "difference. Sweep up and down in front of the stand",
      directions.up_s > directions.down_s ? "up" : "down", directions.up_s, directions.down_s);
}

}  // namespace

Status LidarCalibrationOptions::Check() const {
  FORESIGHT_CHECK(noise.Check());
  if (rounds.empty())
    return Fail(ErrorCode::kInvalidOptions, "calibration: rounds of association are missing");
  for (const AssociationOptions& round : rounds) FORESIGHT_CHECK(round.Check());
  if (!(huber_sigmas >= 0.0) || !(gate_sigmas >= 0.0))
    return Fail(ErrorCode::kInvalidOptions,
                "calibration: huber_sigmas {} or gate_sigmas {} is negative", huber_sigmas,
                gate_sigmas);
  return {};
}

std::vector<BoardHits> WithinGate(const ChainData& data, const ChainState& state,
                                  const std::vector<BoardHits>& all, double gate_sigmas) {
  std::vector<BoardHits> kept;
  for (const BoardHits& hits : all) {
    const std::vector<double> residuals = RangeResiduals(data, state, hits);
    BoardHits within = hits;
    within.returns.clear();
    for (std::size_t i = 0; i < residuals.size(); ++i)
      if (std::abs(residuals[i]) <= gate_sigmas * hits.returns[i].sigma_m)
        within.returns.push_back(hits.returns[i]);
    if (!within.returns.empty()) kept.push_back(std::move(within));
  }
  return kept;
}

Result<LidarCalibration> CalibrateLidar(const BoardMount& mount, const ChainState& start,
                                        const std::vector<LidarProfile>& profiles,
                                        const LidarCalibrationOptions& options,
                                        const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  LidarCalibration result;
  result.state = start;
  ChainData data;
  ChainSolveOptions solve{.free = {.lidar = true, .range_offset = options.range_offset},
                          .noise = options.noise,
                          .residual = options.residual,
                          .huber_sigmas = options.huber_sigmas};
  for (const AssociationOptions& round : options.rounds) {
    data.hits = AssociateReturns(mount, data, result.state, profiles, round);
    FORESIGHT_CHECK(CheckEnough(data.hits));
    FORESIGHT_TRY(result.fit, SolveChain(data, solve, &result.state, context));
  }
  if (options.gate_sigmas > 0.0) {
    AssociationOptions last = options.rounds.back();
    last.straight_line = false;
    data.hits = AssociateReturns(mount, data, result.state, profiles, last);
    data.hits = WithinGate(data, result.state, data.hits, options.gate_sigmas);
    FORESIGHT_CHECK(CheckEnough(data.hits));
    solve.huber_sigmas = 0.0;
    FORESIGHT_TRY(result.fit, SolveChain(data, solve, &result.state, context));
  }
  if (const auto covariance = CovarianceOfChain(data, solve, result.state); !covariance)
    return tl::unexpected(covariance.error());
  Measure(data, &result);
  if (const auto linear = LinearPose(result.state, data.hits)) {
    const auto step = StepBetween(*linear, result.state.camera_from_lidar);
    result.linear = {step.head<3>().norm(), step.tail<3>().norm()};
  }
  result.hits = std::move(data.hits);
  return result;
}

Result<TimeCalibration> CalibrateTime(const CalibrationSession& session, const ChainState& start,
                                      const std::vector<BoardHits>& still, double range_sigma_m,
                                      const LidarCalibrationOptions& options,
                                      const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  TimeCalibration result;
  result.state = start;
  ChainData data;
  for (const PatternPose& pose : session.poses) data.tracks.push_back(pose.sweep.track);
  const std::vector<LidarProfile> profiles = ProfilesOfSweeps(session, range_sigma_m);
  if (profiles.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "time: the session has no sweep. Sweep up and down in front of the stand, at 50 "
                "deg/s or more");
  FORESIGHT_CHECK(CheckBothWays(DirectionsOf(data.tracks)));
  ChainSolveOptions solve{
      .free = {.lidar = true, .range_offset = options.range_offset, .stamp_offset = true},
      .noise = options.noise,
      .residual = options.residual,
      .huber_sigmas = options.huber_sigmas};
  // An offset of 25 ms at 50 deg/s moves returns by 65 mm at 3 m.
  const std::vector<AssociationOptions> rounds = {{.margin_m = 0.040, .depth_m = 0.150},
                                                  {.margin_m = 0.020, .depth_m = 0.090}};
  for (const AssociationOptions& round : rounds) {
    data.hits = AssociateReturns(session.mount, data, result.state, profiles, round);
    if (CountReturns(data.hits) < kLeastReturns)
      return Fail(ErrorCode::kTooFewPoints,
                  "time: {} returns of the sweep lie on the boards, at least {} are needed. Sweep "
                  "in front of the stand",
                  CountReturns(data.hits), kLeastReturns);
    data.hits.insert(data.hits.end(), still.begin(), still.end());
    FORESIGHT_TRY(result.fit, SolveChain(data, solve, &result.state, context));
  }
  AssociationOptions last = rounds.back();
  last.straight_line = false;
  last.depth_m = std::max(last.depth_m, options.gate_sigmas * range_sigma_m);
  data.hits = AssociateReturns(session.mount, data, result.state, profiles, last);
  data.hits.insert(data.hits.end(), still.begin(), still.end());
  data.hits = WithinGate(data, result.state, data.hits, options.gate_sigmas);
  solve.huber_sigmas = 0.0;
  FORESIGHT_TRY(result.fit, SolveChain(data, solve, &result.state, context));
  FORESIGHT_TRY(const ChainCovariance covariance, CovarianceOfChain(data, solve, result.state));
  result.sigma_s = covariance.Sigma(covariance.Find("stamp offset"));
  int up = 0, all = 0;
  for (const BoardHits& hits : data.hits) {
    if (hits.visit != BoardHits::kNone) continue;
    const MotorTrack& track = data.tracks[static_cast<std::size_t>(hits.pose)];
    const double time_s = hits.returns.front().time_s;
    const int count = static_cast<int>(hits.returns.size());
    if (track.AngleAt(time_s + 0.01) > track.AngleAt(time_s - 0.01)) up += count;
    all += count;
  }
  result.up_ratio = static_cast<double>(up) / std::max(1, all);
  if (std::min(result.up_ratio, 1.0 - result.up_ratio) < 0.5 * kLeastRatio)
    return Fail(ErrorCode::kInvalidInput,
                "time: {:.0f} % of the returns on boards are from the way up. Sweep up and down in "
                "front of the stand",
                100.0 * result.up_ratio);
  result.tracks = data.tracks;
  for (BoardHits& hits : data.hits)
    if (hits.visit == BoardHits::kNone) result.hits.push_back(std::move(hits));
  return result;
}

}  // namespace foresight
