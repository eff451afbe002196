#include "core/selfcheck/pass_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/base/tukey_weight.h"

namespace foresight {
namespace {

/// The plate's way during a line, at a constant speed.
struct LineWay {
  int line = 0;
  double first_rad = 0.0;  ///< at the first beam
  double by_beam_rad = 0.0;
  double speed_rad_s = 0.0;

  double At(double beam) const { return first_rad + beam * by_beam_rad; }
};

/// Of the lines that were taken while the plate turned.
std::vector<LineWay> WaysOf(const Scan& scan, double least_speed_rad_s) {
  const LidarModel& lidar = scan.rig.lidar;
  const double line_s = lidar.BeamTime(lidar.beams - 1) - lidar.BeamTime(0);
  std::vector<LineWay> ways;
  int index = 0;
  for (const LidarLine& line : scan.lines) {
    const auto plate_at = [&](int beam) {
      return scan.rig.angle_correction.PlateAngle(
          scan.track.AngleAt(line.time_s + lidar.BeamTime(beam)));
    };
    const double first = plate_at(0), last = plate_at(lidar.beams - 1);
    const double speed = (last - first) / line_s;
    // NaN fails the comparison.
    if (std::abs(speed) >= least_speed_rad_s)
      ways.push_back({index, first, (last - first) / (lidar.beams - 1), speed});
    ++index;
  }
  return ways;
}

/// By how much the ways up and down of a patch differ, and by how much a stamp would part them.
struct PatchOffset {
  double offset_m = 0.0;  ///< up less down
  double sigma_m = 0.0;
  double by_stamp = 0.0;  ///< m/s
  int group = 0;
};

/// The beams [first, first + beams) of some lines.
class RangePatch {
 public:
  RangePatch(const RegisteredScan& cloud, int first, const PassCheckOptions& options)
      : cloud_(cloud), first_(first), options_(options) {}

  void Add(const LineWay& way) {
    const double side = way.speed_rad_s > 0.0 ? 0.5 : -0.5;
    int& lines = way.speed_rad_s > 0.0 ? up_ : down_;
    double& speeds = way.speed_rad_s > 0.0 ? up_speeds_ : down_speeds_;
    ++lines;
    speeds += way.speed_rad_s;
    for (int beam = first_; beam < first_ + options_.beams; ++beam) {
      if (!cloud_.Valid(way.line, beam)) continue;
      rows_.push_back({{1.0, way.At(beam), static_cast<double>(beam - first_), side},
                       cloud_.range_m[cloud_.Index(way.line, beam)]});
    }
  }

  std::optional<PatchOffset> Offset() const {
    if (std::min(up_, down_) < options_.least_lines) return std::nullopt;
    const double all = static_cast<double>(options_.beams) * (up_ + down_);
    if (static_cast<double>(rows_.size()) < options_.least_filled * all) return std::nullopt;
    Eigen::Vector4d mean = Eigen::Vector4d::Zero();
    for (const Row& row : rows_) mean += row.by / static_cast<double>(rows_.size());
    mean[0] = mean[3] = 0.0;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const Row& row : rows_) {
      normal += (row.by - mean) * (row.by - mean).transpose();
      right += (row.by - mean) * row.range_m;
    }
    const Eigen::Matrix4d inverse = normal.inverse();
    const Eigen::Vector4d fit = inverse * right;
    double squares = 0.0;
    for (const Row& row : rows_) squares += std::pow(row.range_m - fit.dot(row.by - mean), 2);
    const double variance = squares / (static_cast<double>(rows_.size()) - 4.0);
    if (!(variance < options_.most_rms_m * options_.most_rms_m)) return std::nullopt;
    return PatchOffset{fit[3], std::hypot(std::sqrt(variance * inverse(3, 3)), options_.floor_m),
                       fit[1] * (up_speeds_ / up_ - down_speeds_ / down_), 0};
  }

  double MeanSpeed() const { return 0.5 * (up_speeds_ / up_ - down_speeds_ / down_); }

 private:
  struct Row {
    Eigen::Vector4d by;  ///< of 1, the plate's angle, the beam and the way
    double range_m = 0.0;
  };

  const RegisteredScan& cloud_;
  int first_;
  const PassCheckOptions& options_;
  std::vector<Row> rows_;
  int up_ = 0, down_ = 0;
  double up_speeds_ = 0.0, down_speeds_ = 0.0;
};

/// Weighted least squares of one unknown, with Tukey's weights.
class StampAdjustment {
 public:
  StampAdjustment(std::vector<PatchOffset> patches, const PassCheckOptions& options)
      : patches_(std::move(patches)), options_(options) {}

  double Solve() {
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
      UpdateWeights();
      stamp_s_ = Without(-1);
    }
    return stamp_s_;
  }

  double Sigma() const {
    double information = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < patches_.size(); ++i)
      information += weights_[i] * patches_[i].by_stamp * patches_[i].by_stamp;
    for (int group = 0; group < options_.groups; ++group)
      variance +=
          std::pow(Without(group) - stamp_s_, 2) * (options_.groups - 1.0) / options_.groups;
    return std::sqrt(scale_ * scale_ / information + variance);
  }

 private:
  double Off(const PatchOffset& patch) const {
    return (patch.offset_m - stamp_s_ * patch.by_stamp) / patch.sigma_m;
  }
  void UpdateWeights() {
    std::vector<double> offs;
    for (const PatchOffset& patch : patches_) offs.push_back(std::abs(Off(patch)));
    constexpr double kMadToSigma = 1.4826;
    scale_ = std::max(1.0, kMadToSigma * UpperMedian(std::move(offs)));
    weights_.clear();
    for (const PatchOffset& patch : patches_) {
      const double u = Off(patch) / (scale_ * options_.tukey_sigmas);
      const double full = 1.0 / (patch.sigma_m * patch.sigma_m);
      weights_.push_back(full * TukeyWeight(u));
    }
  }
  double Without(int group) const {
    double matrix = 0.0, right = 0.0;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      const PatchOffset& patch = patches_[i];
      if (patch.group == group) continue;
      matrix += weights_[i] * patch.by_stamp * patch.by_stamp;
      right += weights_[i] * patch.by_stamp * patch.offset_m;
    }
    return matrix > 0.0 ? right / matrix : 0.0;
  }

  std::vector<PatchOffset> patches_;
  const PassCheckOptions& options_;
  std::vector<double> weights_;
  double scale_ = 1.0;
  double stamp_s_ = 0.0;
};

}  // namespace

Result<PassCheck> CheckPasses(const Scan& scan, const RegisteredScan& cloud,
                              const PassCheckOptions& options) {
  const std::vector<LineWay> ways = WaysOf(scan, options.least_speed_rad_s);
  const auto up = std::count_if(ways.begin(), ways.end(),
                                [](const LineWay& way) { return way.speed_rad_s > 0.0; });
  if (up < options.least_lines || std::ssize(ways) - up < options.least_lines)
    return Fail(ErrorCode::kTooFewPoints,
                "the scan sweeps one way; a scan there and back shows it");
  std::vector<PatchOffset> patches;
  double speeds = 0.0;
  const int blocks = cloud.beams / options.beams;
  for (int block = 0; block < blocks; ++block) {
    const int first = block * options.beams;
    std::vector<LineWay> here = ways;
    const auto angle = [&](const LineWay& way) { return way.At(first + 0.5 * options.beams); };
    std::sort(here.begin(), here.end(),
              [&](const LineWay& a, const LineWay& b) { return angle(a) < angle(b); });
    for (std::size_t begin = 0; begin < here.size();) {
      RangePatch patch(cloud, first, options);
      std::size_t end = begin;
      while (end < here.size() && angle(here[end]) < angle(here[begin]) + options.turn_rad)
        patch.Add(here[end++]);
      begin = end;
      auto offset = patch.Offset();
      if (!offset) continue;
      offset->group = block * options.groups / blocks;
      speeds += patch.MeanSpeed();
      patches.push_back(*offset);
    }
  }
  PassCheck check;
  check.patches = static_cast<int>(patches.size());
  if (check.patches < options.least_patches)
    return Fail(ErrorCode::kTooFewPoints,
                "{} patches of surfaces are seen on both ways, {} are needed: scan slower, where "
                "floor, ceiling or sloping surfaces are in view",
                check.patches, options.least_patches);
  check.speed_rad_s = speeds / check.patches;
  StampAdjustment adjustment(std::move(patches), options);
  check.stamp_s = adjustment.Solve();
  check.sigma_s = adjustment.Sigma();
  return check;
}

}  // namespace foresight
