#include "core/calibration/lidar_profiles.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/base/random.h"
#include "core/calibration/chain_angles.h"

namespace foresight {
namespace {

std::vector<double> RangesOf(const std::vector<LidarLine>& lines, int beam,
                             const LidarModel& lidar) {
  std::vector<double> ranges;
  for (const LidarLine& line : lines) {
    const double range = line.RawRange(beam);
    if (range >= lidar.min_range_m && range <= lidar.max_range_m) ranges.push_back(range);
  }
  return ranges;
}

/// The mean of a beam over a stop's lines; none where it has no steady range.
std::optional<LidarReturn> MeanReturn(std::vector<double> ranges, std::size_t lines,
                                      double range_sigma_m, double floor_m) {
  if (2 * ranges.size() < lines || ranges.empty()) return std::nullopt;
  constexpr double kMostSigmas = 3.5;
  const double median = UpperMedian(ranges);
  double sum = 0.0;
  int used = 0;
  for (const double range : ranges)
    if (std::abs(range - median) <= kMostSigmas * range_sigma_m) sum += range, ++used;
  if (2 * static_cast<std::size_t>(used) < lines) return std::nullopt;
  LidarReturn mean;
  mean.range_m = sum / used;
  mean.sigma_m = std::max(floor_m, range_sigma_m / std::sqrt(static_cast<double>(used)));
  return mean;
}

/// A return, predicted in a board's frame.
struct Candidate {
  std::size_t index = 0;  ///< in the profile
  int beam = 0;
  Eigen::Vector3d on_board;
  double sigma_m = 0.0;
};

/// Where a beam was measured, and where it should meet the board.
struct Prediction {
  Eigen::Vector3d measured;
  Eigen::Vector3d on_plane;  ///< NaN where the beam does not meet it
};

Prediction Predict(const Rigid<frame::Pattern, frame::Lidar>& board_from_lidar,
                   const LidarReturn& r, double range_offset_m) {
  const Eigen::Vector3d& from = board_from_lidar.translation();
  const Eigen::Vector3d direction = board_from_lidar.Rotate(r.direction);
  constexpr double kLeastSine = 0.1;  // a flatter beam says little of the board
  const double range = std::abs(direction.z()) < kLeastSine ? -1.0 : -from.z() / direction.z();
  return {from + (r.range_m + range_offset_m) * direction,
          range > 0.0 ? Eigen::Vector3d(from + range * direction)
                      : Eigen::Vector3d::Constant(std::nan(""))};
}

// Whether a beam meets the board is told from its direction alone. Told from its range, beams along
// the outline would be taken where their noise carries them inside: a bias that grows with the
// number of lines.
std::vector<Candidate> CandidatesOf(const CalibrationBoard& board,
                                    const std::vector<Prediction>& predicted,
                                    const LidarProfile& profile,
                                    const AssociationOptions& options) {
  const double s = board.square_m, margin = options.margin_m;
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const Eigen::Vector3d& p = predicted[i].on_plane;
    const bool inside = p.x() > -s + margin && p.x() < board.columns * s - margin &&
                        p.y() > -s + margin && p.y() < board.rows * s - margin;
    if (inside && std::abs(predicted[i].measured.z()) < options.depth_m)
      candidates.push_back(
          {i, profile.returns[i].beam, predicted[i].measured, profile.returns[i].sigma_m});
  }
  return candidates;
}

/// A straight line through space.
struct Line {
  Eigen::Vector3d point, direction;
  double Distance(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d from = p - point;
    return (from - from.dot(direction) * direction).norm();
  }
};

std::vector<Candidate> NearLine(const std::vector<Candidate>& candidates, const Line& line) {
  constexpr double kMostSigmas = 3.0, kLeast_m = 0.008;  // boards bend by millimetres
  std::vector<Candidate> near;
  for (const Candidate& candidate : candidates)
    if (line.Distance(candidate.on_board) <= std::max(kMostSigmas * candidate.sigma_m, kLeast_m))
      near.push_back(candidate);
  return near;
}

/// Those on the line that most candidates agree with.
std::vector<Candidate> MostOnALine(const std::vector<Candidate>& candidates,
                                   const AssociationOptions& options, Random& random) {
  constexpr int kTries = 60;  // half of the candidates on the line: all tries fail once in 3e7
  std::vector<Candidate> best;
  const int count = static_cast<int>(candidates.size());
  for (int i = 0; i < kTries; ++i) {
    const Candidate& a = candidates[static_cast<std::size_t>(random.Index(count))];
    const Candidate& b = candidates[static_cast<std::size_t>(random.Index(count))];
    const Eigen::Vector3d between = b.on_board - a.on_board;
    constexpr double kLeastApart_m = 0.03;
    if (between.norm() < kLeastApart_m) continue;
    if (std::abs(between.z()) > std::sin(options.most_tilt_rad) * between.norm()) continue;
    auto near = NearLine(candidates, {a.on_board, between.normalized()});
    if (near.size() > best.size()) best = std::move(near);
  }
  return best;
}

/// The longest sequence without a gap of many beams.
std::vector<Candidate> LongestRun(const std::vector<Candidate>& candidates) {
  constexpr int kMostGap = 4;
  std::size_t best_first = 0, best_size = 0, first = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0 && candidates[i].beam - candidates[i - 1].beam > kMostGap) first = i;
    if (i - first + 1 > best_size) best_first = first, best_size = i - first + 1;
  }
  const auto at = candidates.begin() + static_cast<std::ptrdiff_t>(best_first);
  return {at, at + static_cast<std::ptrdiff_t>(best_size)};
}

}  // namespace

double RangeSigmaOf(const CalibrationSession& session) {
  std::vector<std::vector<double>> beams;
  std::vector<double> deviations;
  for (const PatternPose& pose : session.poses)
    for (const MotorStop& stop : pose.stops)
      for (int beam = 0; beam < session.prior.lidar.beams && stop.lines.size() >= 5; beam += 4) {
        std::vector<double> ranges = RangesOf(stop.lines, beam, session.prior.lidar);
        if (2 * ranges.size() < stop.lines.size() || ranges.size() < 5) continue;
        const double median = UpperMedian(ranges);
        for (double& range : ranges) {
          range -= median;
          deviations.push_back(std::abs(range));
        }
        beams.push_back(std::move(ranges));
      }
  if (deviations.empty()) return std::nan("");
  // Ranges are whole millimetres, and so is the median deviation: it only tells spikes from the
  // rest. Of a normal distribution 0.9733 of the variance lie within 3 deviations.
  constexpr double kSigmasOfMedian = 1.4826, kGate = 3.0, kVarianceInGate = 0.9733;
  const double rough_m = std::max(kSigmasOfMedian * UpperMedian(deviations), 0.0005);
  double squares = 0.0, freedom = 0.0;
  for (const std::vector<double>& beam : beams) {
    double sum = 0.0, sum_squares = 0.0, count = 0.0;
    for (const double deviation : beam) {
      if (std::abs(deviation) > kGate * rough_m) continue;
      sum += deviation;
      sum_squares += deviation * deviation;
      count += 1.0;
    }
    if (2.0 * count < static_cast<double>(beam.size()) || count < 3.0) continue;
    squares += sum_squares - sum * sum / count;
    freedom += count - 1.0;
  }
  if (freedom <= 0.0) return rough_m;
  return std::max(std::sqrt(squares / (freedom * kVarianceInGate)), 0.0005);
}

std::vector<LidarProfile> ProfilesOfStops(const CalibrationSession& session,
                                          const std::vector<double>& stops_rad,
                                          double range_sigma_m, double floor_m) {
  const LidarModel& lidar = session.prior.lidar;
  std::vector<LidarProfile> profiles;
  int visit = 0;
  for (std::size_t pose = 0; pose < session.poses.size(); ++pose)
    for (const MotorStop& stop : session.poses[pose].stops) {
      const int own = visit++;
      if (stop.lines.empty()) continue;
      LidarProfile profile{static_cast<int>(pose), own, StopIndex(stops_rad, stop.motor_rad), {}};
      for (int beam = 0; beam < lidar.beams; ++beam) {
        auto mean = MeanReturn(RangesOf(stop.lines, beam, lidar), stop.lines.size(), range_sigma_m,
                               floor_m);
        if (!mean) continue;
        mean->direction = lidar.BeamDirection(beam);
        mean->beam = beam;
        profile.returns.push_back(*mean);
      }
      profiles.push_back(std::move(profile));
    }
  return profiles;
}

std::vector<LidarProfile> ProfilesOfSweeps(const CalibrationSession& session,
                                           double range_sigma_m) {
  const LidarModel& lidar = session.prior.lidar;
  LidarModel at_stamp = lidar;
  at_stamp.stamp_offset_s = 0.0;
  std::vector<LidarProfile> profiles;
  for (std::size_t pose = 0; pose < session.poses.size(); ++pose)
    for (const LidarLine& line : session.poses[pose].sweep.lines) {
      LidarProfile profile;
      profile.pose = static_cast<int>(pose);
      for (int beam = 0; beam < lidar.beams; ++beam) {
        const double range = line.RawRange(beam);
        if (!(range >= lidar.min_range_m && range <= lidar.max_range_m)) continue;
        profile.returns.push_back({lidar.BeamDirection(beam), range, range_sigma_m,
                                   line.time_s + at_stamp.BeamTime(beam), beam});
      }
      profiles.push_back(std::move(profile));
    }
  return profiles;
}

Status AssociationOptions::Check() const {
  if (!(margin_m >= 0.0) || !(depth_m > 0.0) || !(most_tilt_rad > 0.0) || least_returns < 3)
    return Fail(ErrorCode::kInvalidOptions,
                "association: margin_m {}, depth_m {}, most_tilt_rad {} or least_returns {} is out "
                "of range",
                margin_m, depth_m, most_tilt_rad, least_returns);
  return {};
}

std::vector<BoardHits> AssociateReturns(const BoardMount& mount, const ChainData& tracks,
                                        const ChainState& state,
                                        const std::vector<LidarProfile>& profiles,
                                        const AssociationOptions& options) {
  Random random(options.seed);
  const PlateAngles plate(tracks, state);
  const auto head_from_lidar = state.camera_from_head.Inverse() * state.camera_from_lidar;
  std::vector<BoardHits> all;
  for (const LidarProfile& profile : profiles) {
    for (const bool on_b : {false, true}) {
      if (on_b && !mount.b) continue;
      const auto base_from_stand = state.base_from_pattern[static_cast<std::size_t>(profile.pose)];
      const auto board_from_base =
          (on_b ? base_from_stand * state.a_from_b : base_from_stand).Inverse();
      std::vector<Prediction> predicted;
      for (const LidarReturn& r : profile.returns) {
        const double rad = plate.At(profile.pose, profile.stop, profile.visit, r.time_s);
        const auto board_from_lidar =
            board_from_base * HeadFromBase(rad).Inverse() * head_from_lidar;
        predicted.push_back(Predict(board_from_lidar, r, state.range_offset_m));
      }
      const CalibrationBoard& board = on_b ? *mount.b : mount.a;
      const auto candidates = CandidatesOf(board, predicted, profile, options);
      if (static_cast<int>(candidates.size()) < options.least_returns) continue;
      const auto run =
          options.straight_line ? LongestRun(MostOnALine(candidates, options, random)) : candidates;
      if (static_cast<int>(run.size()) < options.least_returns) continue;
      BoardHits hits{profile.pose, profile.visit, profile.stop, on_b, {}};
      for (const Candidate& candidate : run)
        hits.returns.push_back(profile.returns[candidate.index]);
      all.push_back(std::move(hits));
    }
  }
  return all;
}

}  // namespace foresight
