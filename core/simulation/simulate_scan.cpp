#include "core/simulation/simulate_scan.h"

#include <cmath>

#include "core/base/parallel.h"

namespace foresight {
namespace {

constexpr double kEncoderRate_hz = 240.0;
/// The track reaches beyond the sweep, so that the first and the last beam have an angle.
constexpr double kTrackMargin_s = 0.1;

/// The shaft's angle at a time; 0 s is at the start of the scope. A second pass goes back.
class ConstantSpeed {
 public:
  explicit ConstantSpeed(const ScanPlan& plan)
      : plan_(plan),
        speed_rad_s_(std::copysign(plan.speed_rad_s, plan.to_rad - plan.from_rad)),
        pass_s_((plan.to_rad - plan.from_rad) / speed_rad_s_) {}

  double At(double time_s) const {
    if (plan_.passes == 1 || time_s < pass_s_ + kTurn_s)
      return plan_.from_rad + speed_rad_s_ * time_s;
    return plan_.to_rad - speed_rad_s_ * (time_s - PassStart(1));
  }
  double TimeOf(double angle_rad) const { return (angle_rad - plan_.from_rad) / speed_rad_s_; }
  double PassStart(int pass) const { return pass * (pass_s_ + 2.0 * kTurn_s); }
  double pass_s() const { return pass_s_; }
  double End() const { return PassStart(plan_.passes - 1) + pass_s_; }

 private:
  static constexpr double kTurn_s = kTrackMargin_s;  ///< beyond the scope, before it turns

  const ScanPlan& plan_;
  double speed_rad_s_;  ///< signed, of the first pass
  double pass_s_;
};

MotorTrack EncoderTrack(const World& world, const ConstantSpeed& shaft) {
  MotorTrack track;
  const int first = -static_cast<int>(kEncoderRate_hz * kTrackMargin_s);
  const int last = static_cast<int>(kEncoderRate_hz * (shaft.End() + kTrackMargin_s));
  for (int i = first; i <= last; ++i) {
    const double time_s = i / kEncoderRate_hz;
    track.Add({time_s, world.EncoderAngle(shaft.At(time_s))});
  }
  return track;
}

}  // namespace

Result<Scan> SimulateSweep(const World& world, const ScanPlan& plan, const RunContext& context) {
  FORESIGHT_CHECK(plan.Check());
  if (plan.image_mode != ScanPlan::ImageMode::kOnTheFly)
    return Fail(ErrorCode::kInvalidOptions,
                "simulated sweep: its images are taken on the fly; simulate a head for other "
                "plans");
  const ConstantSpeed shaft(plan);
  const double period_s = world.true_rig().lidar.period_s;
  Scan scan;
  scan.uuid = NewUuid();
  scan.source = fmt::format("simulated: {}, seed {}", world.scene().name, world.options().seed);
  scan.simulated = true;
  scan.plan = plan;
  scan.rig = world.true_rig();
  scan.rig.angle_correction = world.CalibratedCorrection();
  scan.track = EncoderTrack(world, shaft);
  const int lines_a_pass = static_cast<int>(std::ceil(shaft.pass_s() / period_s));
  std::vector<LidarLine> lines(static_cast<std::size_t>(plan.passes * lines_a_pass));
  const bool finished = ParallelFor(static_cast<int>(lines.size()), context, [&](int i) {
    const double time_s = shaft.PassStart(i / lines_a_pass) + (i % lines_a_pass) * period_s;
    lines[static_cast<std::size_t>(i)] =
        world.MeasureLine(i, time_s, [&](double at_s) { return shaft.At(at_s); });
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "the simulated sweep was cancelled");
  scan.lines = std::move(lines);
  scan.state = ScanState::kComplete;
  return scan;
}

Result<Scan> SimulateScan(const World& world, const ScanPlan& plan, const RunContext& context) {
  FORESIGHT_TRY(Scan scan, SimulateSweep(world, plan, context.Part(0.0, 0.5)));
  const ConstantSpeed shaft(plan);
  for (std::size_t i = 0; i < plan.image_angles_rad.size(); ++i) {
    const double time_s = shaft.TimeOf(plan.image_angles_rad[i]);
    CameraFrame frame = world.CaptureImage(
        static_cast<std::int64_t>(i), time_s, plan.exposure_s, plan.gain_db,
        [&](double at_s) { return shaft.At(at_s); }, context.Part(0.5, 1.0));
    if (frame.image.empty()) return Fail(ErrorCode::kCancelled, "the simulated scan was cancelled");
    frame.motor_angle_rad = scan.track.AngleAt(time_s);
    frame.target_angle_rad = plan.image_angles_rad[i];
    scan.frames.push_back(std::move(frame));
  }
  return scan;
}

}  // namespace foresight
