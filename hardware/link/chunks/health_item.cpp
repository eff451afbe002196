#include "hardware/link/chunks/health_item.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/io/json_reader.h"

namespace foresight {
namespace {

using Json = nlohmann::json;

/// Members that are missing keep their default; null is a number that is not known.
class Members {
 public:
  Members(const Json& object, const char* key) : object_(object.at(key)) {}

  void Read(const char* key, double& value) const {
    if (!object_.contains(key)) return;
    const Json& member = object_.at(key);
    value = member.is_null() ? std::numeric_limits<double>::quiet_NaN() : member.get<double>();
  }
  template <class T>
  void Read(const char* key, T& value) const {
    if (object_.contains(key)) object_.at(key).get_to(value);
  }

 private:
  const Json& object_;
};

LidarHealth LidarFrom(const Json& health) {
  const Members members(health, "lidar");
  LidarHealth lidar;
  members.Read("connected", lidar.connected);
  members.Read("streaming", lidar.streaming);
  members.Read("line_rate_hz", lidar.line_rate_hz);
  members.Read("lines", lidar.lines);
  members.Read("lost_lines", lidar.lost_lines);
  members.Read("damaged", lidar.damaged);
  members.Read("stale", lidar.stale);
  members.Read("stalls", lidar.stalls);
  members.Read("reconnects", lidar.reconnects);
  members.Read("reboots", lidar.reboots);
  members.Read("clock_offset_s", lidar.clock_offset_s);
  members.Read("clock_drift_ppm", lidar.clock_drift_ppm);
  members.Read("sync_round_trip_s", lidar.sync_round_trip_s);
  members.Read("last_error", lidar.last_error);
  return lidar;
}

CameraHealth CameraFrom(const Json& health) {
  const Members members(health, "camera");
  CameraHealth camera;
  members.Read("connected", camera.connected);
  members.Read("suspect", camera.suspect);
  members.Read("frames", camera.frames);
  members.Read("lost", camera.lost);
  members.Read("incomplete", camera.incomplete);
  members.Read("underruns", camera.underruns);
  members.Read("resent_packets", camera.resent_packets);
  members.Read("missing_packets", camera.missing_packets);
  members.Read("reconnects", camera.reconnects);
  members.Read("temperature_c", camera.temperature_c);
  members.Read("clock_offset_s", camera.clock_offset_s);
  members.Read("clock_uncertainty_s", camera.clock_uncertainty_s);
  members.Read("last_error", camera.last_error);
  return camera;
}

MotorHealth MotorFrom(const Json& health) {
  const Members members(health, "motor");
  MotorHealth motor;
  members.Read("connected", motor.connected);
  members.Read("poll_rate_hz", motor.poll_rate_hz);
  members.Read("polls", motor.polls);
  members.Read("round_trip_median_s", motor.round_trip_median_s);
  members.Read("round_trip_max_s", motor.round_trip_max_s);
  members.Read("reconnects", motor.reconnects);
  members.Read("slow_polls", motor.slow_polls);
  members.Read("last_error", motor.last_error);
  return motor;
}

HeadHealth HealthFrom(const Json& health) {
  return {LidarFrom(health), CameraFrom(health), MotorFrom(health)};
}

template <class Read>
auto Parse(std::string_view json, const std::string& source, const Read& read)
    -> Result<decltype(read(Json()))> {
  try {
    return read(ParseJson(json));
  } catch (const std::bad_alloc&) {
    return Fail(ErrorCode::kIo, "{}: device health: no memory", source);
  } catch (const std::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: device health: {}", source, error.what());
  }
}

}  // namespace

std::string ToJson(const HealthReport& report) {
  return R"({"at_start":)" + ToJson(report.at_start) + R"(,"at_end":)" + ToJson(report.at_end) +
         "}";
}

Result<HealthReport> HealthReportFromJson(std::string_view json, const std::string& source) {
  return Parse(json, source, [](const Json& report) {
    return HealthReport{HealthFrom(report.at("at_start")), HealthFrom(report.at("at_end"))};
  });
}

Result<HeadHealth> HeadHealthFromJson(std::string_view json, const std::string& source) {
  return Parse(json, source, [](const Json& health) { return HealthFrom(health); });
}

}  // namespace foresight
