#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "core/base/random.h"
#include "core/mission/mission_file.h"
#include "core/sensor/scan.h"

namespace foresight {

/// A small scan with every kind of value in it: status codes, a lost line, ragged motor samples.
inline Scan SampleScan(std::uint64_t seed) {
  Random random(seed);
  Scan scan;
  scan.uuid = "scan-" + std::to_string(seed);
  scan.start_utc_ns = 1700000000123456789;
  scan.source = "simulated: caf\xc3\xa9, seed 1";
  scan.simulated = true;
  scan.plan.image_angles_rad = {-0.1, 1.0 / 3.0};
  scan.rig = DefaultSensorRig();
  scan.rig.angle_correction =
      AngleCorrection::FromKnots({{-0.5, -0.49}, {0.0, 0.001}, {0.5, 0.52}}).value();
  for (int i = 0; i < 20; ++i) {
    LidarLine line;
    line.seq = i < 7 ? i : i + 2;
    line.time_s = 12.3 + 0.025 * static_cast<double>(line.seq);
    for (int beam = 0; beam < 1081; ++beam) {
      const double range_mm = 3000.0 + 900.0 * std::sin(0.01 * beam) + 4.0 * random.Normal();
      line.range_mm.push_back(
          static_cast<std::uint16_t>(random.Index(50) == 0 ? 1 : std::lround(range_mm)));
      line.intensity.push_back(static_cast<std::uint16_t>(random.Index(65536)));
    }
    scan.lines.push_back(line);
  }
  for (int i = 0; i < 130; ++i)
    scan.track.Add({12.2 + i / 240.0, -0.5 + 0.0003490658503988659 * random.Index(3000)});
  for (int i = 0; i < 2; ++i) {
    CameraFrame frame;
    frame.seq = i;
    frame.time_s = 12.4 + 0.1 * i;
    frame.exposure_s = 0.004;
    frame.gain_db = 3.0;
    frame.motor_angle_rad = -0.1001 + i;
    frame.target_angle_rad = scan.plan.image_angles_rad[static_cast<std::size_t>(i)];
    frame.image = ColorImage(41, 31);
    for (Rgb8& pixel : frame.image.values()) pixel.g = static_cast<std::uint8_t>(random.Index(256));
    scan.frames.push_back(frame);
  }
  scan.state = ScanState::kComplete;
  return scan;
}

/// The same frame with an image of 4 MB that no PNG makes smaller: more than SQLite keeps in
/// memory.
inline CameraFrame NoiseFrame(CameraFrame frame) {
  Random random(7);
  frame.image = ColorImage(1300, 1000);
  for (Rgb8& pixel : frame.image.values()) {
    const std::uint64_t bits = random.Next();
    pixel = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
             static_cast<std::uint8_t>(bits >> 16)};
  }
  return frame;
}

/// Records everything but the end; returns the scan's id.
inline std::int64_t RecordWithoutEnd(MissionFile& mission, const Scan& scan) {
  const std::int64_t id = mission.BeginScan(scan).value();
  const std::span<const MotorSample> samples = scan.track.samples();
  EXPECT_TRUE(mission.AppendMotorSamples(id, samples.first(samples.size() / 2)));
  for (const LidarLine& line : scan.lines) EXPECT_TRUE(mission.AppendLine(id, line));
  EXPECT_TRUE(mission.AppendMotorSamples(id, samples));
  for (const CameraFrame& frame : scan.frames) EXPECT_TRUE(mission.AppendFrame(id, frame));
  return id;
}

inline std::int64_t Record(MissionFile& mission, const Scan& scan) {
  const std::int64_t id = RecordWithoutEnd(mission, scan);
  EXPECT_TRUE(mission.EndScan(id, scan.state, scan.reason));
  return id;
}

/// Everything of a scan but its rig, whose rotations may differ by 1e-15 after a round trip.
inline bool SameButForTheRig(const Scan& a, const Scan& b) {
  return a.uuid == b.uuid && a.start_utc_ns == b.start_utc_ns && a.source == b.source &&
         a.simulated == b.simulated && a.plan == b.plan && a.lines == b.lines &&
         a.track == b.track && a.frames == b.frames && a.state == b.state && a.reason == b.reason;
}

}  // namespace foresight
