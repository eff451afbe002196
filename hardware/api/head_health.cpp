#include "hardware/api/head_health.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace foresight {
namespace {

using Json = nlohmann::ordered_json;

Json Known(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json AsJson(const LidarHealth& lidar) {
  return {{"connected", lidar.connected},
          {"streaming", lidar.streaming},
          {"line_rate_hz", Known(lidar.line_rate_hz)},
          {"lines", lidar.lines},
          {"lost_lines", lidar.lost_lines},
          {"damaged", lidar.damaged},
          {"stale", lidar.stale},
          {"stalls", lidar.stalls},
          {"reconnects", lidar.reconnects},
          {"reboots", lidar.reboots},
          {"clock_offset_s", Known(lidar.clock_offset_s)},
          {"clock_drift_ppm", Known(lidar.clock_drift_ppm)},
          {"sync_round_trip_s", Known(lidar.sync_round_trip_s)},
          {"last_error", lidar.last_error}};
}

Json AsJson(const CameraHealth& camera) {
  return {{"connected", camera.connected},
          {"suspect", camera.suspect},
          {"frames", camera.frames},
          {"lost", camera.lost},
          {"incomplete", camera.incomplete},
          {"underruns", camera.underruns},
          {"resent_packets", camera.resent_packets},
          {"missing_packets", camera.missing_packets},
          {"reconnects", camera.reconnects},
          {"temperature_c", Known(camera.temperature_c)},
          {"clock_offset_s", Known(camera.clock_offset_s)},
          {"clock_uncertainty_s", Known(camera.clock_uncertainty_s)},
          {"last_error", camera.last_error}};
}

Json AsJson(const MotorHealth& motor) {
  return {{"connected", motor.connected},
          {"poll_rate_hz", Known(motor.poll_rate_hz)},
          {"polls", motor.polls},
          {"round_trip_median_s", Known(motor.round_trip_median_s)},
          {"round_trip_max_s", Known(motor.round_trip_max_s)},
          {"reconnects", motor.reconnects},
          {"slow_polls", motor.slow_polls},
          {"last_error", motor.last_error}};
}

}  // namespace

std::string Describe(const LidarHealth& lidar) {
  return fmt::format("{:.0f} lines/s, {} lost, clock offset {:.3f} s", lidar.line_rate_hz,
                     lidar.lost_lines, lidar.clock_offset_s);
}

std::string Describe(const CameraHealth& camera) {
  const std::string temperature =
      std::isfinite(camera.temperature_c) ? fmt::format(", {:.1f} °C", camera.temperature_c) : "";
  return fmt::format("{} images, {} lost{}", camera.frames, camera.lost, temperature);
}

std::string Describe(const MotorHealth& motor) {
  return fmt::format("{:.0f} polls/s, round trip {:.2f} ms", motor.poll_rate_hz,
                     1e3 * motor.round_trip_median_s);
}

std::string ToJson(const HeadHealth& health) {
  return Json{{"lidar", AsJson(health.lidar)},
              {"camera", AsJson(health.camera)},
              {"motor", AsJson(health.motor)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace foresight
