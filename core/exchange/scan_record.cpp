#include "core/exchange/scan_record.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/io/json_numbers.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostImages = 1000;

double NumberFrom(const nlohmann::json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

CameraFrame ImageFrom(const nlohmann::json& value) {
  CameraFrame frame;
  value.at("seq").get_to(frame.seq);
  value.at("time_s").get_to(frame.time_s);
  value.at("exposure_s").get_to(frame.exposure_s);
  value.at("gain_db").get_to(frame.gain_db);
  frame.motor_angle_rad = NumberFrom(value.at("motor_angle_rad"));
  value.at("target_angle_rad").get_to(frame.target_angle_rad);
  return frame;
}

}  // namespace

std::string ScanRecordToJson(const Scan& scan, const RegisteredScan& cloud) {
  Json images = Json::array(), origins = Json::array();
  for (const CameraFrame& frame : scan.frames)
    images.push_back({{"seq", frame.seq},
                      {"time_s", frame.time_s},
                      {"exposure_s", frame.exposure_s},
                      {"gain_db", frame.gain_db},
                      {"motor_angle_rad", FiniteOrNull(frame.motor_angle_rad)},
                      {"target_angle_rad", frame.target_angle_rad}});
  for (const Eigen::Vector3f& origin : cloud.origins)
    origins.push_back(origin.allFinite() ? Json{origin.x(), origin.y(), origin.z()}
                                         : Json(nullptr));
  return Json{{"foresight_scan", 1},
              {"scan_uuid", scan.uuid},
              {"start_utc_ns", scan.start_utc_ns},
              {"source", scan.source},
              {"simulated", scan.simulated},
              {"rig_yaml", SensorRigToYaml(scan.rig)},
              {"lines", cloud.lines},
              {"beams", cloud.beams},
              {"origins_in_base_m", origins},
              {"images", images}}
             .dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

Result<ScanRecord> ScanRecordFromJson(const std::string& json, const std::string& source) {
  try {
    const nlohmann::json value = ParseJson(json);
    ScanRecord record;
    if (const int version = value.at("foresight_scan").get<int>(); version != 1)
      return Fail(ErrorCode::kBadData, "{}: foresight_scan {} is not known, only 1", source,
                  version);
    value.at("scan_uuid").get_to(record.scan_uuid);
    value.at("start_utc_ns").get_to(record.start_utc_ns);
    value.at("source").get_to(record.source);
    value.at("simulated").get_to(record.simulated);
    FORESIGHT_TRY(record.rig, SensorRigFromYaml(value.at("rig_yaml").get<std::string>(),
                                                source + ", rig_yaml"));
    record.lines = IntegerIn(value, "lines", 1, GivenCloud::kMostLines);
    record.beams = IntegerIn(value, "beams", 1, GivenCloud::kMostBeams);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (const auto& origin : ListIn(value, "origins_in_base_m", GivenCloud::kMostLines)) {
      Eigen::Vector3f place = Eigen::Vector3f::Constant(kNaN);
      for (int axis = 0; !origin.is_null() && axis < 3; ++axis)
        place[axis] = origin.at(static_cast<std::size_t>(axis)).get<float>();
      record.origins.push_back(place);
    }
    for (const auto& image : ListIn(value, "images", kMostImages))
      record.images.push_back(ImageFrom(image));
    if (record.origins.size() != static_cast<std::size_t>(record.lines))
      return Fail(ErrorCode::kBadData, "{}: {} origins for {} lines", source, record.origins.size(),
                  record.lines);
    return record;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return Fail(ErrorCode::kBadData, "{}: {}", source, error.what());
  }
}

}  // namespace foresight
