#include "hardware/emulator/device_faults.h"

#include <cmath>

#include "core/base/atomic_file.h"
#include "core/io/yaml_reader.h"

namespace foresight {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;
constexpr double kMostClockError_ppm = 100'000.0;  // a lidar's; a tenth

/// Text to kind: as ToString writes it, with underscores.
MotorFault::Kind ReadKind(YamlMap& map) {
  const std::string text = map.Text("kind");
  std::string known;
  for (int i = 0; i < MotorFault::kKinds; ++i) {
    std::string name = ToString(static_cast<MotorFault::Kind>(i));
    for (char& c : name) c = c == ' ' ? '_' : c;
    if (name == text) return static_cast<MotorFault::Kind>(i);
    known += (i == 0 ? "" : ", ") + name;
  }
  map.Fault(map.Node("kind"), "'kind' is one of " + known + "; is '" + text + "'");
}

/// A time, at most a month.
double NotNegative(YamlMap& map, const std::string& key, double fallback) {
  constexpr double kLongest_s = 31.0 * 86400.0;
  const double value = map.Number(key, fallback);
  if (value < 0.0)
    map.Fault(map.Node(key), fmt::format("'{}' must not be negative, is {}", key, value));
  if (value > kLongest_s)
    map.Fault(map.Node(key),
              fmt::format("'{}' must be at most {} (a month), is {}", key, kLongest_s, value));
  return value;
}

/// The ratio `what`_ratio, or `what`_share as earlier plans called it.
double Ratio(YamlMap& map, const std::string& what, double fallback) {
  const std::string key = what + "_ratio", old_key = what + "_share";
  if (!map.Has(old_key)) return map.Number(key, fallback);
  if (map.Has(key))
    map.Fault(map.Node(old_key),
              fmt::format("'{}' is the old name of '{}': give one of them", old_key, key));
  return map.Number(old_key, fallback);
}

std::uint32_t Counter(YamlMap& map, const std::string& key, std::uint32_t fallback,
                      std::uint32_t last) {
  const double value = map.Number(key, fallback);
  if (!(value >= 0.0 && value <= last))
    map.Fault(map.Node(key), fmt::format("'{}' must be from 0 to {}, is {}", key, last, value));
  return static_cast<std::uint32_t>(value);
}

LidarFaults ReadLidar(YamlMap map, std::uint64_t seed) {
  LidarFaults faults;
  faults.seed = seed;
  faults.corrupt_fraction = Ratio(map, "corrupt", faults.corrupt_fraction);
  faults.reset_fraction = Ratio(map, "reset", faults.reset_fraction);
  faults.stall_fraction = Ratio(map, "stall", faults.stall_fraction);
  faults.stall_s = NotNegative(map, "stall_s", faults.stall_s);
  faults.fragment_bytes = map.Integer("fragment_bytes", faults.fragment_bytes);
  faults.boot_delay_s = NotNegative(map, "boot_delay_s", faults.boot_delay_s);
  faults.clock_ppm = map.Number("clock_ppm", faults.clock_ppm);
  if (std::abs(faults.clock_ppm) > kMostClockError_ppm)
    map.Fault(map.Node("clock_ppm"), fmt::format("'clock_ppm' must be within {}, is {}",
                                                 kMostClockError_ppm, faults.clock_ppm));
  faults.clock_start_ms = Counter(map, "clock_start_ms", faults.clock_start_ms, 0xFFFFFF);
  faults.clock_jump_s = map.Number("clock_jump_s", faults.clock_jump_s);
  faults.clock_jump_after_s = map.Number("clock_jump_after_s", faults.clock_jump_after_s);
  faults.clock_stop_after_s = map.Number("clock_stop_after_s", faults.clock_stop_after_s);
  faults.missing_beams = map.Integer("missing_beams", faults.missing_beams);
  faults.abnormal = map.Flag("abnormal", faults.abnormal);
  faults.ignores_first_quit = map.Flag("ignores_first_quit", faults.ignores_first_quit);
  map.Finish();
  if (const Status status = faults.Check(); !status) map.Fault(status.error().message);
  return faults;
}

CameraFaults ReadCamera(YamlMap map, std::uint64_t seed) {
  CameraFaults faults;
  faults.seed = seed;
  faults.packet_loss_ratio = Ratio(map, "packet_loss", faults.packet_loss_ratio);
  faults.ignored_trigger_fraction = Ratio(map, "ignored_trigger", faults.ignored_trigger_fraction);
  faults.slow_frame_fraction = Ratio(map, "slow_frame", faults.slow_frame_fraction);
  faults.slow_s = NotNegative(map, "slow_s", faults.slow_s);
  faults.vanish_after_s = NotNegative(map, "vanish_after_s", faults.vanish_after_s);
  faults.vanish_s = NotNegative(map, "vanish_s", faults.vanish_s);
  faults.clock_ppm = map.Number("clock_ppm", faults.clock_ppm);
  faults.clock_start_s = NotNegative(map, "clock_start_s", faults.clock_start_s);
  faults.first_block =
      static_cast<std::uint16_t>(Counter(map, "first_block", faults.first_block, 0xFFFF));
  map.Finish();
  if (const Status status = faults.Check(); !status) map.Fault(status.error().message);
  return faults;
}

MotorFault ReadMotorFault(YamlMap& map) {
  MotorFault fault;
  fault.kind = ReadKind(map);
  fault.after_s = NotNegative(map, "after_s", fault.after_s);
  fault.duration_s = NotNegative(map, "duration_s", fault.duration_s);
  map.Finish();
  return fault;
}

/// `{mean_interval_s: 10, span_s: 600}`
std::vector<MotorFault> ReadRandomMotorFaults(YamlMap map, std::uint64_t seed) {
  const double mean_s = map.Number("mean_interval_s");
  if (mean_s < 0.1)
    map.Fault(map.Node("mean_interval_s"),
              fmt::format("'mean_interval_s' must be at least 0.1, is {}", mean_s));
  const double span_s = NotNegative(map, "span_s", 3600.0);
  map.Finish();
  constexpr double kMostFaults = 100'000.0;
  if (span_s / mean_s > kMostFaults)
    map.Fault(fmt::format("one fault in {} s for {} s makes more than {} faults", mean_s, span_s,
                          kMostFaults));
  return RandomMotorFaults(seed, mean_s, span_s);
}

}  // namespace

Result<DeviceFaults> DeviceFaultsFromYaml(const std::string& yaml, const std::string& source,
                                          std::uint64_t seed) {
  DeviceFaults faults;
  FORESIGHT_CHECK(ParseYaml(yaml, source, [&](YamlMap& map) {
    if (const int version = map.Integer("foresight_faults"); version != 1)
      map.Fault(map.Node("foresight_faults"),
                fmt::format("'foresight_faults' is {}; this program knows version 1", version));
    faults.lidar.seed = faults.camera.seed = seed;
    if (map.Has("lidar")) faults.lidar = ReadLidar(map.Map("lidar"), seed);
    if (map.Has("camera")) faults.camera = ReadCamera(map.Map("camera"), seed);
    if (map.Has("random_motor"))
      faults.motor = ReadRandomMotorFaults(map.Map("random_motor"), seed);
    for (YamlMap& fault : map.List("motor")) faults.motor.push_back(ReadMotorFault(fault));
    map.Finish();
  }));
  return faults;
}

Result<DeviceFaults> LoadDeviceFaults(const std::filesystem::path& path, std::uint64_t seed) {
  FORESIGHT_TRY(const std::string yaml, ReadFile(path, kLargestFile));
  return DeviceFaultsFromYaml(yaml, path.string(), seed);
}

}  // namespace foresight
