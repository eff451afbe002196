// Accuracy and covariance over many simulated sessions, against the bars of the field's own study.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "core/geometry/angles.h"
#include "tests/core/calibration/chain/calibrated_session.h"

namespace foresight {
namespace {

struct Distribution {
  std::vector<double> values;
  double Rms() const {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
  }
  double Most() const {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }
  /// The value that 95 of 100 stay below.
  double P95() const {
    std::vector<double> sorted;
    for (const double value : values) sorted.push_back(std::abs(value));
    std::sort(sorted.begin(), sorted.end());
    return sorted[(sorted.size() * 95) / 100];
  }
};

void Print(const std::string& name, const Distribution& d) {
  std::cout << fmt::format("{:<24} rms {:.4f}, 95 % within {:.4f}, most {:.4f}\n", name, d.Rms(),
                           d.P95(), d.Most());
}

/// The deviation that the covariance predicts for the unknowns whose names begin so: the root of
/// the sum of their squares.
double Predicted(const ChainCovariance& covariance, const std::string& start) {
  double squares = 0.0;
  for (std::size_t i = 0; i < covariance.unknowns.size(); ++i)
    if (covariance.unknowns[i].name.starts_with(start))
      squares += std::pow(covariance.Sigma(static_cast<int>(i)), 2);
  return std::sqrt(squares);
}

/// A session that misses a joint bar, beside what it could know: its data, not the solve, are the
/// limit where the error is of the size that was predicted.
struct Miss {
  std::uint64_t seed = 0;
  const char* what = "";
  double error_deg = 0.0, predicted_deg = 0.0;
};

TEST(CalibrationStatistics, SessionsThatMissAJointBarMissWhatTheirCovarianceAllows) {
  constexpr double kAxisBar_deg = 0.035, kAnglesBar_deg = 0.030;
  Distribution axis, angles;  // errors, by what is predicted for each session
  Distribution axis_predicted, angles_predicted;
  std::vector<Miss> misses;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CalibrationSimulation options;
    options.seed = seed;
    options.mount = static_cast<CameraMount>(seed % 3);
    options.range_bias_m = seed % 2 == 0 ? 0.020 : 0.0;
    const auto session = samples::CalibrateSimulated(options);
    ASSERT_TRUE(session.found.covariance);
    const double stops = static_cast<double>(session.found.rig.angle_correction.knots().size());
    const Miss of_axis{seed, "axis", DegreesFromRadians(session.error.axis_rad),
                       DegreesFromRadians(Predicted(*session.found.covariance, "axis turn"))};
    const Miss of_angles{
        seed, "angles", DegreesFromRadians(session.error.angles_rms_rad),
        DegreesFromRadians(Predicted(*session.found.covariance, "plate angle")) / std::sqrt(stops)};
    axis_predicted.values.push_back(of_axis.predicted_deg);
    angles_predicted.values.push_back(of_angles.predicted_deg);
    axis.values.push_back(of_axis.error_deg / of_axis.predicted_deg);
    angles.values.push_back(of_angles.error_deg / of_angles.predicted_deg);
    if (of_axis.error_deg > kAxisBar_deg) misses.push_back(of_axis);
    if (of_angles.error_deg > kAnglesBar_deg) misses.push_back(of_angles);
  }
  Print("axis, predicted deg", axis_predicted);
  Print("angles, predicted deg", angles_predicted);
  Print("axis, by predicted", axis);
  Print("angles, by predicted", angles);
  for (const Miss& miss : misses)
    std::cout << fmt::format("seed {}: {} {:.3f} deg, predicted {:.3f} deg\n", miss.seed, miss.what,
                             miss.error_deg, miss.predicted_deg);
  // Two unknowns of one common deviation are within 3.3 of it in 29 of 30 times 30 draws.
  EXPECT_LT(axis.Most(), 3.3);
  EXPECT_LT(angles.Most(), 3.3);
  // As a whole the errors are those that were predicted.
  EXPECT_NEAR(axis.Rms(), 1.0, 0.4);
  EXPECT_NEAR(angles.Rms(), 1.0, 0.4);
}

TEST(CalibrationStatistics, ThirtySessionsOfEachMountReachTheBars) {
  std::map<std::string, Distribution> all;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CalibrationSimulation options;
    options.seed = seed;
    options.mount = static_cast<CameraMount>(seed % 3);
    options.range_bias_m = seed % 2 == 0 ? 0.020 : 0.0;
    const auto session = samples::CalibrateSimulated(options);
    all["axis, deg"].values.push_back(DegreesFromRadians(session.error.axis_rad));
    all["axis, mm"].values.push_back(1000.0 * session.error.axis_m);
    all["angles, deg"].values.push_back(DegreesFromRadians(session.error.angles_rms_rad));
    all["lidar, deg"].values.push_back(DegreesFromRadians(session.error.lidar_rad));
    all["lidar, mm"].values.push_back(1000.0 * session.error.lidar_m);
    all["range offset, mm"].values.push_back(1000.0 * session.error.range_offset_m);
    all["stamp offset, ms"].values.push_back(1000.0 * session.error.stamp_offset_s);
    all["focal length, px"].values.push_back(session.error.focal_px);
    all["mean error, px"].values.push_back(session.found.mean_error_px);
    all["joint solve, s"].values.push_back(session.found.seconds.joint);
  }
  for (const auto& [name, distribution] : all) Print(name, distribution);
  EXPECT_LT(all["axis, deg"].Most(), 0.060);
  EXPECT_LT(all["axis, deg"].Rms(), 0.035);
  EXPECT_LT(all["axis, mm"].Most(), 0.8);
  // The angles' common scale is that of the focal length, which differs from session to session.
  EXPECT_LT(all["angles, deg"].Rms(), 0.030);
  EXPECT_LT(all["lidar, deg"].Most(), 0.2);
  EXPECT_LT(all["lidar, mm"].Most(), 3.0);
  EXPECT_LT(all["range offset, mm"].Most(), 4.0);
  EXPECT_LT(all["stamp offset, ms"].Most(), 1.0);
}

TEST(CalibrationStatistics, CovarianceIsThatOfFiftySessions) {
  std::map<std::string, Distribution> deviations;
  Distribution chi, corners, ranges;
  for (std::uint64_t seed = 101; seed <= 150; ++seed) {
    CalibrationSimulation options;
    options.seed = seed;
    options.mount = static_cast<CameraMount>(seed % 3);
    const auto session = samples::CalibrateSimulated(options);
    if (!session.found.covariance) continue;
    const ChainCovariance& covariance = *session.found.covariance;
    const Eigen::VectorXd errors = DeviationsFromTruth(session.found, session.made);
    for (int i = 0; i < errors.size(); ++i)
      deviations[covariance.unknowns[static_cast<std::size_t>(i)].name].values.push_back(
          errors[i] / covariance.Sigma(i));
    chi.values.push_back(session.found.fit->ReducedChiSquare());
    corners.values.push_back(session.found.corners.chi_square);
    ranges.values.push_back(session.found.ranges.chi_square);
  }
  ASSERT_EQ(chi.values.size(), 50u);
  Print("reduced chi-square", chi);
  Print("of corners", corners);
  Print("of ranges", ranges);
  double mean = 0.0;
  for (const double value : chi.values) mean += value / 50.0;
  EXPECT_NEAR(mean, 1.0, 0.05);
  for (const auto& [name, distribution] : deviations) {
    Print(name, distribution);
    // Of 50 sessions the ratio itself is known to 10 %.
    EXPECT_GT(distribution.Rms(), 0.7) << name;
    EXPECT_LT(distribution.Rms(), 1.4) << name;
  }
}

}  // namespace
}  // namespace foresight
