#include "core/simulation/simulate_scan.h"

#include <cmath>

#include "core/base/parallel.h"

namespace foresight {
namespace {

constexpr double kEncoderRate_hz = 240.0;
/// The track reaches beyond the sweep, so that the first and the last beam have an angle.
constexpr double kTrackMargin_s = 0.1;

/// The shaft's angle at a time; 0 s is at the start of the scope.
struct ConstantSpeed {
  double from_rad;
  double speed_rad_s;  ///< signed

  double At(double time_s) const { return from_rad + speed_rad_s * time_s; }
  double TimeOf(double angle_rad) const { return (angle_rad - from_rad) / speed_rad_s; }
};

MotorTrack EncoderTrack(const World& world, const ConstantSpeed& shaft, double duration_s) {
  MotorTrack track;
  const int first = -static_cast<int>(kEncoderRate_hz * kTrackMargin_s);
  const int last = static_cast<int>(kEncoderRate_hz * (duration_s + kTrackMargin_s));
  for (int i = first; i <= last; ++i) {
    const double time_s = i / kEncoderRate_hz;
    track.Add({time_s, world.EncoderAngle(shaft.At(time_s))});
  }
  return track;
}

}  // namespace

Result<Scan> SimulateScan(const World& world, const ScanPlan& plan, const RunContext& context) {
  FORESIGHT_CHECK(plan.Check());
  const ConstantSpeed shaft{plan.from_rad,
                            std::copysign(plan.speed_rad_s, plan.to_rad - plan.from_rad)};
  const auto motor_rad_at = [&](double time_s) { return shaft.At(time_s); };
  const double duration_s = shaft.TimeOf(plan.to_rad);
  const double period_s = world.true_rig().lidar.period_s;

  Scan scan;
  scan.uuid = NewUuid();
  scan.source = fmt::format("simulated: {}, seed {}", world.scene().name, world.options().seed);
  scan.simulated = true;
  scan.plan = plan;
  scan.rig = world.true_rig();
  scan.rig.angle_correction = world.CalibratedCorrection();
  scan.track = EncoderTrack(world, shaft, duration_s);
  scan.lines.resize(static_cast<std::size_t>(std::ceil(duration_s / period_s)));
  const bool finished =
      ParallelFor(static_cast<int>(scan.lines.size()), context.Part(0.0, 0.5), [&](int i) {
        scan.lines[static_cast<std::size_t>(i)] = world.MeasureLine(i, i * period_s, motor_rad_at);
      });
  for (std::size_t i = 0; finished && i < plan.image_angles_rad.size(); ++i) {
    const double time_s = shaft.TimeOf(plan.image_angles_rad[i]);
    CameraFrame frame = world.TakePicture(static_cast<std::int64_t>(i), time_s, plan.exposure_s,
                                          plan.gain_db, motor_rad_at, context.Part(0.5, 1.0));
    frame.motor_angle_rad = scan.track.AngleAt(time_s);
    frame.target_angle_rad = plan.image_angles_rad[i];
    scan.frames.push_back(std::move(frame));
  }
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the simulated scan was cancelled");
  scan.state = ScanState::kComplete;
  return scan;
}

}  // namespace foresight
