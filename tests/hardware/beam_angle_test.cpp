// Where the plate was when a beam was measured: what a registered scan uses against the truth, over
// the wires of all three devices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/quantile.h"
#include "tests/hardware/emulated_head.h"

namespace foresight {
namespace {

/// Errors of many beams, in degrees.
class AngleErrors {
 public:
  void Add(double error_rad) { magnitudes_.push_back(std::abs(DegreesFromRadians(error_rad))); }

  std::size_t size() const { return magnitudes_.size(); }
  double Rms() const {
    double sum = 0.0;
    for (const double error : magnitudes_) sum += error * error;
    return std::sqrt(sum / static_cast<double>(size()));
  }
  double Quantile(double fraction) const { return foresight::Quantile(magnitudes_, fraction); }
  void Print(double speed_deg_s, const char* name) const {
    std::printf("%2.0f deg/s, %-28s rms %.4f, 95 %% %.4f, largest %.4f deg\n", speed_deg_s, name,
                Rms(), Quantile(0.95), Quantile(1.0));
  }

 private:
  std::vector<double> magnitudes_;
};

/// A calibration of the plate at every degree instead of every ten.
AngleCorrection DenseCorrection(const World& world) {
  std::vector<AngleCorrection::Knot> knots;
  for (int degrees = -90; degrees <= 90; ++degrees) {
    const double motor_rad = RadiansFromDegrees(degrees);
    knots.push_back({motor_rad, world.PlateAngle(motor_rad, true)});
  }
  return AngleCorrection::FromKnots(std::move(knots)).value();
}

/// What each link of the chain adds to a beam's angle, and what comes of all together.
struct BeamAngles {
  AngleErrors track;       ///< motor's track at the true time, against the shaft
  AngleErrors stamps;      ///< the plate's way between the beam's time and its true time
  AngleErrors correction;  ///< the calibrated plate angle at the true shaft angle
  AngleErrors all;         ///< what the registered scan uses, against the plate
  AngleErrors all_dense;   ///< the same with a correction that has a knot a degree
};

/// Beams that were measured while the shaft was within the plan's scope.
BeamAngles CompareBeams(const Scan& scan, const ScanPlan& plan, const EmulatedDevices& devices) {
  const World& world = *devices.world();
  const LidarModel& believed = scan.rig.lidar;
  const LidarModel& truth = world.true_rig().lidar;
  const AngleCorrection dense = DenseCorrection(world);
  BeamAngles errors;
  for (const LidarLine& line : scan.lines) {
    const double turn_s = std::round(line.time_s / truth.period_s) * truth.period_s;
    for (int beam = 0; beam < truth.beams; ++beam) {
      const double true_s = turn_s + truth.BeamTime(beam);
      const double shaft_rad = devices.ShaftAngle(true_s);
      if (shaft_rad < plan.from_rad || shaft_rad > plan.to_rad) continue;
      const double plate_rad = world.PlateAngle(shaft_rad, true);
      const double used_rad = scan.track.AngleAt(line.time_s + believed.BeamTime(beam));
      const double track_rad = scan.track.AngleAt(true_s);
      errors.track.Add(track_rad - shaft_rad);
      errors.stamps.Add(used_rad - track_rad);
      errors.correction.Add(scan.rig.angle_correction.PlateAngle(shaft_rad) - plate_rad);
      errors.all.Add(scan.rig.angle_correction.PlateAngle(used_rad) - plate_rad);
      errors.all_dense.Add(dense.PlateAngle(used_rad) - plate_rad);
    }
  }
  return errors;
}

/// The whole fan, and a camera that costs nothing. The lidar's mirror turns as slowly as measured
/// on devices, and its clock is a usual quartz's.
EmulatedDevicesOptions LidarDevices() {
  EmulatedDevicesOptions options = RealTimeDevices();
  options.true_rig.camera = TinyRig().camera;
  options.true_rig.lidar.period_s = 0.02505;
  options.faults.lidar.clock_ppm = 50.0;
  options.faults.lidar.clock_start_ms = 123'456;
  return options;
}

class BeamAngle : public testing::TestWithParam<double> {};

TEST_P(BeamAngle, IsWithinThreeHundredthsOfADegreeOfThePlate) {
  const double speed_deg_s = GetParam();
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-30.0);
  plan.to_rad = RadiansFromDegrees(30.0);
  plan.speed_rad_s = RadiansFromDegrees(speed_deg_s);
  EmulatedHead bench(std::make_shared<const Scene>(TinyWorld()->scene()), LidarDevices());
  const auto scan = bench.Execute(plan);
  ASSERT_TRUE(scan) << bench.head->Status().message;
  ASSERT_EQ(scan->state, ScanState::kComplete) << scan->reason;

  const BeamAngles errors = CompareBeams(*scan, plan, *bench.devices);
  errors.track.Print(speed_deg_s, "motor's track");
  errors.stamps.Print(speed_deg_s, "time stamps");
  errors.correction.Print(speed_deg_s, "correction between its knots");
  errors.all.Print(speed_deg_s, "beam");
  errors.all_dense.Print(speed_deg_s, "beam, a knot a degree");
  if (kSanitized) GTEST_SKIP() << "executed for its threads; a sanitizer's time is no measure";
  // 60 deg are 2400 lines at 1 deg/s; all beams of all lines but two at the ends.
  EXPECT_GT(errors.all.size(), (2400.0 / speed_deg_s - 3.0) * 1081.0);
  EXPECT_LT(errors.track.Rms(), 0.01);
  // A stamp is a millisecond wide. Half of it is enough on a quiet machine; beside other work lines
  // arrive late, and 0.54 ms was seen.
  EXPECT_LT(errors.stamps.Quantile(0.95), 1.0e-3 * speed_deg_s);
  // Knots every 10 deg do not see the plate's error of 50 periods a turn: 0.019 deg of this.
  EXPECT_LT(errors.all.Rms(), 0.03);
  EXPECT_LT(errors.all_dense.Quantile(0.95), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Speeds, BeamAngle, testing::Values(10.0, 30.0), [](const auto& speed) {
  return fmt::format("{:.0f}DegreesASecond", speed.param);
});

}  // namespace
}  // namespace foresight
