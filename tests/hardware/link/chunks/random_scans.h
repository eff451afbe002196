#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/sensor/scan.h"
#include "hardware/api/sensor_head.h"
#include "hardware/link/chunks/chunk_source.h"
#include "hardware/link/chunks/health_item.h"

namespace foresight::samples {

/// Beams that lie on a wall with noise, on an edge now and then, and status codes.
inline LidarLine RandomLine(Random& random, int beams, bool with_intensity) {
  LidarLine line;
  double range_mm = random.Uniform(100.0, 30000.0);
  for (int beam = 0; beam < beams; ++beam) {
    if (random.Index(40) == 0) range_mm = random.Uniform(23.0, 60000.0);
    range_mm = std::clamp(range_mm + 10.0 * random.Normal(), 23.0, 65535.0);
    const bool status = random.Index(50) == 0;
    line.range_mm.push_back(
        static_cast<std::uint16_t>(status ? random.Index(23) : std::lround(range_mm)));
    if (with_intensity) line.intensity.push_back(static_cast<std::uint16_t>(random.Index(65536)));
  }
  return line;
}

inline void AddRandomLines(Random& random, int count, Scan& scan) {
  std::int64_t seq = random.Index(1000);
  double time_s = random.Uniform(0.0, 5.0);
  const bool intensity = random.Index(4) != 0;
  for (int i = 0; i < count; ++i) {
    const bool odd_one = random.Index(30) == 0;
    LidarLine line = RandomLine(random, odd_one ? random.Index(40) : scan.rig.lidar.beams,
                                intensity && random.Index(30) != 0);
    line.seq = seq;
    line.time_s = time_s;
    scan.lines.push_back(std::move(line));
    const int step = random.Index(20) == 0 ? 2 + random.Index(30) : 1;  // lost lines
    seq += step;
    time_s += 0.025 * step + 1e-4 * random.Normal();
  }
}

inline CameraFrame RandomFrame(Random& random, std::int64_t seq) {
  CameraFrame frame;
  frame.seq = seq;
  frame.time_s = random.Uniform(0.0, 10.0);
  frame.exposure_s = random.Uniform(1e-4, 0.1);
  frame.gain_db = random.Uniform(0.0, 20.0);
  frame.motor_angle_rad = random.Normal();
  frame.target_angle_rad = random.Normal();
  frame.image = ColorImage(1 + random.Index(400), 1 + random.Index(300));
  const bool gray = random.Index(2) == 0;
  for (Rgb8& pixel : frame.image.values()) {
    const auto value = [&] { return static_cast<std::uint8_t>(random.Index(256)); };
    pixel = {value(), value(), value()};
    if (gray) pixel.g = pixel.b = pixel.r;
  }
  return frame;
}

inline void AddRandomTrack(Random& random, int samples, Scan& scan) {
  double time_s = random.Uniform(-1.0, 5.0);
  const double step_rad = random.Index(5) == 0 ? 1e6 : 3.4906585e-4;  // an encoder gone mad, too
  for (int i = 0; i < samples; ++i) {
    scan.track.Add({time_s, step_rad * random.Index(3000)});
    time_s += 1.0 / 240.0 + 1e-5 * random.Uniform();
  }
}

/// Any scan that a head may bring home: `lines` of a small lidar, two passes now and then.
inline Scan RandomScan(std::uint64_t seed, int lines, int frames) {
  Random random(seed);
  Scan scan;
  scan.uuid = "00000000-0000-4000-8000-" + std::to_string(100000000000 + seed);
  scan.start_utc_ns = 1700000000123456789 + static_cast<std::int64_t>(seed);
  scan.source = "simulated: caf\xc3\xa9, seed " + std::to_string(seed);
  scan.simulated = random.Index(2) == 0;
  scan.plan.image_angles_rad = {-0.1, 1.0 / 3.0};
  scan.plan.passes = 1 + random.Index(2);
  scan.rig = DefaultSensorRig();
  scan.rig.name = "rig " + std::to_string(seed);
  scan.rig.lidar.beams = 1 + random.Index(120);
  scan.rig.angle_correction =
      AngleCorrection::FromKnots({{-0.5, -0.49}, {0.0, 0.001}, {0.5, 0.52}}).value();
  AddRandomLines(random, lines, scan);
  AddRandomTrack(random, random.Index(400), scan);
  for (int i = 0; i < frames; ++i) scan.frames.push_back(RandomFrame(random, i));
  scan.state = random.Index(2) == 0 ? ScanState::kComplete : ScanState::kInterrupted;
  if (scan.state != ScanState::kComplete) scan.reason = "the lidar is silent";
  return scan;
}

inline HealthReport SomeHealth() {
  HealthReport health;
  health.at_start.lidar.connected = true;
  health.at_end.lidar.lines = 440;
  health.at_end.lidar.last_error = "say \"ouch\"";
  health.at_end.motor.last_error = 0x8611;
  return health;
}

inline ScanToSend WithHealth(const Scan& scan) {
  return {scan, ToJson(SomeHealth())};
}

/// Everything that the scan has, kind by kind, whether or not it would travel.
inline std::vector<Chunk> AllChunks(const ScanToSend& source) {
  std::vector<Chunk> chunks;
  const ItemCounts counts = ItemsOf(source);
  for (int kind = 1; kind <= kChunkKinds; ++kind)
    for (std::int64_t item = 0; item < counts[static_cast<ChunkKind>(kind)]; ++item) {
      const ItemId id{static_cast<ChunkKind>(kind), item};
      const auto bytes = EncodeItem(source, id);
      if (!bytes) {
        ADD_FAILURE() << bytes.error().message;
        continue;
      }
      const auto parts = SplitItem(id, *bytes).value();
      chunks.insert(chunks.end(), parts.begin(), parts.end());
    }
  return chunks;
}

template <class T>
void Shuffle(std::vector<T>& values, Random& random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[static_cast<std::size_t>(random.Index(static_cast<int>(i)))]);
}

/// Everything but the rig, which has no ==; its YAML says all of it.
inline void ExpectSame(const Scan& a, const Scan& b) {
  EXPECT_EQ(a.uuid, b.uuid);
  EXPECT_EQ(a.start_utc_ns, b.start_utc_ns);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.simulated, b.simulated);
  EXPECT_TRUE(a.plan == b.plan);
  EXPECT_EQ(SensorRigToYaml(a.rig), SensorRigToYaml(b.rig));
  EXPECT_TRUE(a.lines == b.lines);
  EXPECT_TRUE(a.track == b.track);
  EXPECT_TRUE(a.frames == b.frames);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.reason, b.reason);
}

/// Keeps what a sink hears, as a recorder does.
class KeepingSink : public ScanSink {
 public:
  void OnScanStarted(const Scan& header) override {
    EXPECT_EQ(started++, 0);
    scan = header;
  }
  void OnLine(const LidarLine& line) override {
    EXPECT_EQ(started, 1);
    scan.lines.push_back(line);
  }
  void OnMotorSamples(std::span<const MotorSample> samples) override {
    for (const MotorSample& sample : samples) scan.track.Add(sample);
  }
  void OnFrame(const CameraFrame& frame) override { scan.frames.push_back(frame); }
  void OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) override {
    EXPECT_EQ(ended, 0);
    health = {at_start, at_end};
  }
  void OnScanEnded(ScanState state, const std::string& reason) override {
    EXPECT_EQ(ended++, 0);
    scan.state = state;
    scan.reason = reason;
  }

  Scan scan;
  HealthReport health;
  int started = 0;
  int ended = 0;
};

}  // namespace foresight::samples
