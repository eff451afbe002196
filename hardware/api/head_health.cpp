#include "hardware/api/head_health.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace foresight {
namespace {

using Json = nlohmann::ordered_json;

/// The names of all members, for both directions.
template <class Lidar, class Visit>
void VisitLidar(Lidar& lidar, const Visit& visit) {
  visit("connected", lidar.connected);
  visit("streaming", lidar.streaming);
  visit("line_rate_hz", lidar.line_rate_hz);
  visit("lines", lidar.lines);
  visit("lost_lines", lidar.lost_lines);
  visit("damaged", lidar.damaged);
  visit("stale", lidar.stale);
  visit("stalls", lidar.stalls);
  visit("reconnects", lidar.reconnects);
  visit("reboots", lidar.reboots);
  visit("clock_offset_s", lidar.clock_offset_s);
  visit("clock_drift_ppm", lidar.clock_drift_ppm);
  visit("sync_round_trip_s", lidar.sync_round_trip_s);
  visit("last_error", lidar.last_error);
  visit("trouble", lidar.trouble);
}

template <class Camera, class Visit>
void VisitCamera(Camera& camera, const Visit& visit) {
  visit("connected", camera.connected);
  visit("suspect", camera.suspect);
  visit("frames", camera.frames);
  visit("lost", camera.lost);
  visit("incomplete", camera.incomplete);
  visit("underruns", camera.underruns);
  visit("resent_packets", camera.resent_packets);
  visit("missing_packets", camera.missing_packets);
  visit("reconnects", camera.reconnects);
  visit("temperature_c", camera.temperature_c);
  visit("clock_offset_s", camera.clock_offset_s);
  visit("clock_uncertainty_s", camera.clock_uncertainty_s);
  visit("last_error", camera.last_error);
}

template <class Motor, class Visit>
void VisitMotor(Motor& motor, const Visit& visit) {
  visit("connected", motor.connected);
  visit("poll_rate_hz", motor.poll_rate_hz);
  visit("polls", motor.polls);
  visit("round_trip_median_s", motor.round_trip_median_s);
  visit("round_trip_max_s", motor.round_trip_max_s);
  visit("reconnects", motor.reconnects);
  visit("slow_polls", motor.slow_polls);
  visit("last_error", motor.last_error);
}

/// Writes each member into a JSON object; what is not known becomes null.
struct Writer {
  Json& object;

  template <class T>
  void operator()(const char* name, const T& value) const {
    object[name] = value;
  }
  void operator()(const char* name, double value) const {
    object[name] = std::isfinite(value) ? Json(value) : Json(nullptr);
  }
};

/// Reads each member, as far as the object has it: another version may know more or fewer.
struct Reader {
  const Json& object;

  template <class T>
  void operator()(const char* name, T& value) const {
    if (const auto found = object.find(name); found != object.end()) found->get_to(value);
  }
  void operator()(const char* name, double& value) const {
    if (const auto found = object.find(name); found != object.end())
      value = found->is_null() ? std::numeric_limits<double>::quiet_NaN() : found->get<double>();
  }
};

const Json& DeviceIn(const Json& health, const char* name) {
  const Json& device = health.at(name);
  if (!device.is_object()) throw std::invalid_argument(std::string(name) + " is no object");
  return device;
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
  Json json;
  VisitLidar(health.lidar, Writer{json["lidar"]});
  VisitCamera(health.camera, Writer{json["camera"]});
  VisitMotor(health.motor, Writer{json["motor"]});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<HeadHealth> HeadHealthFromJson(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    HeadHealth health;
    VisitLidar(health.lidar, Reader{DeviceIn(json, "lidar")});
    VisitCamera(health.camera, Reader{DeviceIn(json, "camera")});
    VisitMotor(health.motor, Reader{DeviceIn(json, "motor")});
    return health;
  } catch (const std::exception& error) {
    return Fail(ErrorCode::kBadData, "health of the devices: {}", error.what());
  }
}

}  // namespace foresight
