#include "tests/ui/synthetic_scan.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

constexpr double kWallZ_m = 2.0;
constexpr double kFarthest_m = 6.0;

SensorRig SmallRig() {
  SensorRig rig = DefaultSensorRig();
  rig.name = "synthetic";
  rig.camera = {.width = 644,
                .height = 482,
                .fx = 300.5,
                .fy = 300.5,
                .cx = 321.5,
                .cy = 240.5,
                .lens = FisheyeLens{0.9413}};
  return rig;
}

struct Surface {
  double range_m = 0.0;  ///< NaN = nothing
  bool valve = false;
};

/// Follows a ray of base to the wall or, by sphere tracing, to the valve.
Surface Look(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const double wall = direction.z() > 0.05 ? (kWallZ_m - origin.z()) / direction.z() : std::nan("");
  const auto object_from_base = SyntheticValvePose().Inverse();
  const ValveModel model = SyntheticValve();
  const Eigen::Vector3d from = object_from_base * origin;
  const Eigen::Vector3d way = object_from_base.Rotate(direction);
  const double nearest = -from.dot(way);
  if ((from + nearest * way).norm() < 0.25) {
    double range = std::max(0.0, nearest - 0.3);
    for (int step = 0; step < 200 && range < nearest + 0.3; ++step) {
      const double distance = model.Distance(from + range * way);
      if (distance < 2e-4) return {range, true};
      range += distance;
    }
  }
  return {wall < kFarthest_m ? wall : std::nan(""), false};
}

LidarLine MeasureLine(const Scan& scan, int index) {
  LidarLine line;
  line.seq = index;
  line.time_s = 0.1 + index * scan.rig.lidar.period_s;
  const auto base_from_lidar = [&](double time_s) {
    return scan.rig.BaseFromHead(scan.track.AngleAt(time_s)) * scan.rig.HeadFromLidar();
  };
  for (int beam = 0; beam < scan.rig.lidar.beams; ++beam) {
    const auto pose = base_from_lidar(line.time_s + scan.rig.lidar.BeamTime(beam));
    const Surface seen = Look(pose.translation(), pose.Rotate(scan.rig.lidar.BeamDirection(beam)));
    line.range_mm.push_back(std::isfinite(seen.range_m)
                                ? static_cast<std::uint16_t>(std::lround(1000.0 * seen.range_m))
                                : 1);
    line.intensity.push_back(seen.valve ? 3000 : 1500);
  }
  return line;
}

CameraFrame CaptureImage(const Scan& scan, double motor_rad) {
  CameraFrame frame;
  frame.motor_angle_rad = frame.target_angle_rad = motor_rad;
  frame.image = ColorImage(scan.rig.camera.width, scan.rig.camera.height);
  const auto base_from_camera = scan.rig.CameraFromBase(motor_rad).Inverse();
  for (int v = 0; v < frame.image.height(); ++v) {
    for (int u = 0; u < frame.image.width(); ++u) {
      const auto ray = scan.rig.camera.Unproject({u, v});
      if (!ray) continue;
      const Surface seen = Look(base_from_camera.translation(), base_from_camera.Rotate(*ray));
      frame.image(u, v) = seen.valve ? Rgb8{190, 60, 50} : Rgb8{150, 150, 140};
    }
  }
  return frame;
}

}  // namespace

ValveModel SyntheticValve() {
  ValveModel model;
  model.rim_radius_m = 0.20;
  model.tube_radius_m = 0.015;
  model.spokes = 3;
  return model;
}

Rigid<frame::Base, frame::Object> SyntheticValvePose() {
  // z of the object points to the viewer: against base z.
  return {Eigen::Quaterniond(Eigen::AngleAxisd(3.141592653589793, Eigen::Vector3d::UnitX())),
          Eigen::Vector3d(0.1, 0.05, 1.8)};
}

Scan WallAndValveScan(const ScanPlan& plan) {
  Scan scan;
  scan.uuid = NewUuid();
  scan.start_utc_ns = 1'700'000'000'000'000'000;
  scan.source = "synthetic: wall and valve";
  scan.simulated = true;
  scan.plan = plan;
  scan.rig = SmallRig();
  const double duration_s = std::abs(plan.to_rad - plan.from_rad) / plan.speed_rad_s;
  const double way = plan.to_rad > plan.from_rad ? 1.0 : -1.0;
  for (double time = 0.0; time < duration_s + 0.4; time += 0.005)
    scan.track.Add({time, plan.from_rad + way * plan.speed_rad_s * (time - 0.1)});
  const int lines = static_cast<int>(duration_s / scan.rig.lidar.period_s);
  for (int i = 0; i < lines; ++i) scan.lines.push_back(MeasureLine(scan, i));
  for (const double angle : plan.image_angles_rad) scan.frames.push_back(CaptureImage(scan, angle));
  scan.state = ScanState::kComplete;
  return scan;
}

}  // namespace foresight
