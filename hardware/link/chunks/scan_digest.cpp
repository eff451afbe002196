#include "hardware/link/chunks/scan_digest.h"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/sha256.h"
#include "core/mission/plan_json.h"

namespace foresight {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are hashed as they lie");
static_assert(sizeof(Rgb8) == 3, "a pixel is three bytes");

/// Numbers as 8 bytes, little-endian, and lengths before what may have any.
class Hasher {
 public:
  Hasher& Number(std::int64_t value) {
    hash_.Add({reinterpret_cast<const char*>(&value), sizeof value});
    return *this;
  }
  /// -0 as 0, every NaN as the same one: a mission keeps neither difference.
  Hasher& Number(double value) {
    return Number(std::isnan(value) ? std::int64_t{-1} : std::bit_cast<std::int64_t>(value + 0.0));
  }
  Hasher& Text(std::string_view text) {
    Number(static_cast<std::int64_t>(text.size()));
    hash_.Add(text);
    return *this;
  }
  template <class T>
  Hasher& Array(std::span<const T> values) {
    return Text({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  std::string Hex() { return hash_.Hex(); }

 private:
  Sha256 hash_;
};

void Add(Hasher& hash, const LidarLine& line) {
  hash.Number(line.seq)
      .Number(line.time_s)
      .Array(std::span(line.range_mm))
      .Array(std::span(line.intensity));
}

void Add(Hasher& hash, const CameraFrame& frame) {
  hash.Number(frame.seq)
      .Number(frame.time_s)
      .Number(frame.exposure_s)
      .Number(frame.gain_db)
      .Number(frame.motor_angle_rad)
      .Number(frame.target_angle_rad)
      .Number(std::int64_t{frame.image.width()})
      .Number(std::int64_t{frame.image.height()})
      .Array(frame.image.values());
}

/// NaN of whatever bits as the same one.
void AddFloats(Hasher& hash, std::span<const float> values) {
  std::vector<float> same(values.begin(), values.end());
  for (float& value : same)
    value = std::isnan(value) ? std::numeric_limits<float>::quiet_NaN() : value + 0.0f;
  hash.Array(std::span<const float>(same));
}

void AddPlaces(Hasher& hash, std::span<const Eigen::Vector3f> places) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "a place is three floats");
  AddFloats(hash, {reinterpret_cast<const float*>(places.data()), 3 * places.size()});
}

void Add(Hasher& hash, const GivenCloud& given) {
  hash.Text("given cloud").Number(std::int64_t{given.lines}).Number(std::int64_t{given.beams});
  AddPlaces(hash, given.points.span());
  AddFloats(hash, given.intensity.span());
  hash.Number(static_cast<std::int64_t>(given.time_s.size()));
  for (const double time : given.time_s) hash.Number(time);
  AddPlaces(hash, given.origins.span());
}

}  // namespace

std::string ScanDigest(const Scan& scan) {
  Hasher hash;
  hash.Text("foresight scan 1")
      .Text(scan.uuid)
      .Number(scan.start_utc_ns)
      .Text(scan.source)
      .Number(std::int64_t{scan.simulated})
      .Text(PlanToJson(scan.plan))
      .Text(SensorRigToYaml(scan.rig))
      .Text(ToString(scan.state))
      .Text(scan.reason);
  hash.Number(static_cast<std::int64_t>(scan.lines.size()));
  for (const LidarLine& line : scan.lines) Add(hash, line);
  hash.Number(static_cast<std::int64_t>(scan.track.samples().size()));
  for (const MotorSample& sample : scan.track.samples())
    hash.Number(sample.time_s).Number(sample.angle_rad);
  hash.Number(static_cast<std::int64_t>(scan.frames.size()));
  for (const CameraFrame& frame : scan.frames) Add(hash, frame);
  if (!scan.given.empty()) Add(hash, scan.given);
  return hash.Hex();
}

}  // namespace foresight
