#include "hardware/assembly/head_config.h"

#include <array>
#include <chrono>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/io/yaml_reader.h"

namespace foresight {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::max();

template <class Value>
using Names = std::vector<std::pair<const char*, Value>>;

const Names<ScipLidarOptions::Data> kLidarData = {
    {"range", ScipLidarOptions::Data::kRange},
    {"range_intensity", ScipLidarOptions::Data::kRangeIntensity},
    {"nearest_echo", ScipLidarOptions::Data::kNearestEcho},
    {"strongest_echo", ScipLidarOptions::Data::kStrongestEcho},
    {"farthest_echo", ScipLidarOptions::Data::kFarthestEcho}};
const Names<cia402::WordOrder> kWordOrders = {{"high_first", cia402::WordOrder::kHighFirst},
                                              {"low_first", cia402::WordOrder::kLowFirst}};
const Names<GigeCameraOptions::Format> kPixelFormats = {
    {"Mono8", GigeCameraOptions::Format::kMono8},
    {"BayerRG8", GigeCameraOptions::Format::kBayerRG8},
    {"RGB8", GigeCameraOptions::Format::kRGB8}};

template <class Value>
std::string NameOf(const Names<Value>& names, Value value) {
  for (const auto& [name, known] : names)
    if (known == value) return name;
  return "";
}

template <class Value>
void ReadName(YamlMap& map, const std::string& key, const Names<Value>& names, Value* value) {
  if (!map.Has(key)) return;
  const std::string text = map.Text(key);
  std::string list;
  for (const auto& [name, known] : names) {
    if (text == name) {
      *value = known;
      return;
    }
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  map.Fault(map.Node(key), fmt::format("'{}' is one of {}; is '{}'", key, list, text));
}

/// A number of the file times `unit`, within limits that are given in the file's unit.
void ReadNumber(YamlMap& map, const std::string& key, double low, double high, double unit,
                double* value) {
  if (!map.Has(key)) return;
  const double number = map.Number(key);
  if (!(number >= low && number <= high)) {
    const std::string range =
        high < kNoLimit ? fmt::format("from {} to {}", low, high) : fmt::format("at least {}", low);
    map.Fault(map.Node(key), fmt::format("'{}' must be {}, is {}", key, range, number));
  }
  *value = unit * number;
}

void ReadSeconds(YamlMap& map, const std::string& key, double low_s, double* value) {
  ReadNumber(map, key, low_s, 3600.0, 1.0, value);
}

void ReadDegrees(YamlMap& map, const std::string& key, double low, double high, double* value) {
  ReadNumber(map, key, low, high, RadiansFromDegrees(1.0), value);
}

int ReadInteger(YamlMap& map, const std::string& key, int low, int high, int fallback) {
  const int value = map.Integer(key, fallback);
  if (value < low || value > high)
    map.Fault(map.Node(key),
              fmt::format("'{}' must be from {} to {}, is {}", key, low, high, value));
  return value;
}

TcpAddress ReadAddress(YamlMap& map, std::uint16_t default_port) {
  const auto address = TcpAddress::Parse(map.Text("address"), default_port);
  if (!address) map.Fault(map.Node("address"), "'address': " + address.error().message);
  if (address->port == 0) map.Fault(map.Node("address"), "'address': port 0 is no device's");
  return *address;
}

/// What the keys cannot say one by one.
void FinishDevice(const YamlMap& map, const Status& checked) {
  map.Finish();
  if (!checked) map.Fault(checked.error().message);
}

void ReadLidar(YamlMap map, ScipLidarOptions* lidar) {
  lidar->address = ReadAddress(map, lidar->address.port);
  ReadName(map, "data", kLidarData, &lidar->data);
  lidar->model = map.Text("model", lidar->model);
  ReadNumber(map, "stamp_offset_s", -0.1, 0.1, 1.0, &lidar->stamp_offset_s);
  ReadSeconds(map, "connect_timeout_s", 0.1, &lidar->connect_timeout_s);
  ReadSeconds(map, "boot_timeout_s", 0.0, &lidar->boot_timeout_s);
  ReadSeconds(map, "stall_s", 0.05, &lidar->stall_s);
  ReadSeconds(map, "lost_s", 0.1, &lidar->lost_s);
  FinishDevice(map, lidar->Check());
}

void ReadHoming(YamlMap map, ModbusMotorOptions* motor) {
  ReadDegrees(map, "search_deg_s", 0.1, 120.0, &motor->homing_search_rad_s);
  ReadDegrees(map, "edge_deg_s", 0.01, 30.0, &motor->homing_edge_rad_s);
  ReadSeconds(map, "timeout_s", 1.0, &motor->homing_timeout_s);
  map.Finish();
}

void ReadMotor(YamlMap map, ModbusMotorOptions* motor) {
  const TcpAddress address = ReadAddress(map, motor->port);
  motor->host = address.host;
  motor->port = address.port;
  ReadName(map, "word_order", kWordOrders, &motor->word_order);
  motor->counts_per_turn =
      ReadInteger(map, "counts_per_turn", 360, 10'000'000, motor->counts_per_turn);
  ReadDegrees(map, "min_angle_deg", -180.0, 180.0, &motor->min_angle_rad);
  ReadDegrees(map, "max_angle_deg", -180.0, 180.0, &motor->max_angle_rad);
  ReadDegrees(map, "max_speed_deg_s", 0.1, 720.0, &motor->max_speed_rad_s);
  ReadDegrees(map, "acceleration_deg_s2", 1.0, 100'000.0, &motor->acceleration_rad_s2);
  ReadNumber(map, "poll_rate_hz", 50.0, 1000.0, 1.0, &motor->poll_rate_hz);
  if (map.Has("response_timeout_s")) {
    double timeout_s = 0.0;
    ReadNumber(map, "response_timeout_s", 0.01, 10.0, 1.0, &timeout_s);
    motor->response_timeout = std::chrono::milliseconds(static_cast<int>(1e3 * timeout_s));
  }
  if (map.Has("homing")) ReadHoming(map.Map("homing"), motor);
  FinishDevice(map, motor->Check());
}

void ReadCamera(YamlMap map, GigeCameraOptions* camera, CameraSettings* exposure) {
  camera->address = map.Text("address");
  ReadName(map, "pixel_format", kPixelFormats, &camera->format);
  ReadNumber(map, "stamp_offset_s", -1.0, 1.0, 1.0, &camera->stamp_offset_s);
  ReadSeconds(map, "frame_timeout_s", 0.05, &camera->frame_timeout_s);
  ReadSeconds(map, "connect_timeout_s", 0.1, &camera->connect_timeout_s);
  camera->packet_bytes = ReadInteger(map, "packet_bytes", 0, 9000, camera->packet_bytes);
  ReadNumber(map, "packet_delay_s", 0.0, 0.01, 1.0, &camera->packet_delay_s);
  ReadNumber(map, "exposure_s", 1e-5, 1.0, 1.0, &exposure->exposure_s);
  ReadNumber(map, "gain_db", 0.0, 48.0, 1.0, &exposure->gain_db);
  FinishDevice(map, camera->Check());
}

void ReadCapture(YamlMap map, CaptureOptions* capture) {
  ReadSeconds(map, "settle_s", 0.001, &capture->settle_s);
  ReadDegrees(map, "travel_speed_deg_s", 0.1, 120.0, &capture->travel_speed_rad_s);
  ReadSeconds(map, "lidar_timeout_s", 0.1, &capture->lidar_timeout_s);
  ReadSeconds(map, "camera_timeout_s", 0.1, &capture->camera_timeout_s);
  ReadSeconds(map, "operator_timeout_s", 0.0, &capture->operator_timeout_s);
  map.Finish();
}

void ReadRig(YamlMap& map, const std::filesystem::path& folder, SensorRig* rig) {
  if (!map.Has("rig")) return;
  Result<SensorRig> loaded = LoadSensorRig(folder / map.Text("rig"));
  if (!loaded) map.Fault(map.Node("rig"), "'rig': " + loaded.error().message);
  *rig = std::move(*loaded);
}

void ReadHead(YamlMap& map, const std::filesystem::path& folder, HeadConfig* config) {
  if (const int version = map.Integer("foresight_head"); version != 1)
    map.Fault(map.Node("foresight_head"),
              fmt::format("'foresight_head' is {}; this program knows version 1", version));
  config->name = map.Text("name", config->name);
  config->simulated = map.Flag("simulated", config->simulated);
  ReadRig(map, folder, &config->rig);
  config->lidar.last_step = config->rig.lidar.beams - 1;
  ReadLidar(map.Map("lidar"), &config->lidar);
  ReadMotor(map.Map("motor"), &config->motor);
  ReadCamera(map.Map("camera"), &config->camera, &config->exposure);
  if (map.Has("capture")) ReadCapture(map.Map("capture"), &config->capture);
  map.Finish();
  // One source for what two of them must know.
  config->capture.description = config->name;
  config->capture.simulated = config->simulated;
  config->capture.acceleration_rad_s2 = config->motor.acceleration_rad_s2;
  // The drive's own time-out comes first: it knows more to say.
  config->capture.homing_timeout_s = config->motor.homing_timeout_s + 5.0;
  if (const Status status = config->capture.Check(); !status) map.Fault(status.error().message);
}

}  // namespace

Result<HeadConfig> HeadConfigFromYaml(const std::string& yaml, const std::string& source,
                                      const std::filesystem::path& folder) {
  HeadConfig config;
  FORESIGHT_CHECK(ParseYaml(yaml, source, [&](YamlMap& map) { ReadHead(map, folder, &config); }));
  return config;
}

Result<HeadConfig> LoadHeadConfig(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string yaml, ReadFile(path, 1 << 20));
  return HeadConfigFromYaml(yaml, path.string(), path.parent_path());
}

std::string HeadConfigToYaml(const HeadConfig& config, const std::string& rig_file) {
  const auto degrees = [](double radians) { return DegreesFromRadians(radians); };
  const ModbusMotorOptions& motor = config.motor;
  std::string text = fmt::format(
      "# A head and its devices: docs/formats.md.\nforesight_head: 1\nname: \"{}\"\n"
      "simulated: {}\nrig: \"{}\"\n",
      config.name, config.simulated, rig_file);
  text += fmt::format(
      "lidar:\n  address: \"{}\"\n  data: {}\n  model: \"{}\"\n  stamp_offset_s: {}\n"
      "  connect_timeout_s: {}\n  boot_timeout_s: {}\n  stall_s: {}\n  lost_s: {}\n",
      config.lidar.address.ToText(), NameOf(kLidarData, config.lidar.data), config.lidar.model,
      config.lidar.stamp_offset_s, config.lidar.connect_timeout_s, config.lidar.boot_timeout_s,
      config.lidar.stall_s, config.lidar.lost_s);
  text += fmt::format(
      "motor:\n  address: \"{}:{}\"\n  word_order: {}\n  counts_per_turn: {}\n"
      "  min_angle_deg: {:.10g}\n  max_angle_deg: {:.10g}\n  max_speed_deg_s: {:.10g}\n"
      "  acceleration_deg_s2: {:.10g}\n  poll_rate_hz: {}\n  response_timeout_s: {}\n"
      "  homing: {{search_deg_s: {:.10g}, edge_deg_s: {:.10g}, timeout_s: {}}}\n",
      motor.host, motor.port, NameOf(kWordOrders, motor.word_order), motor.counts_per_turn,
      degrees(motor.min_angle_rad), degrees(motor.max_angle_rad), degrees(motor.max_speed_rad_s),
      degrees(motor.acceleration_rad_s2), motor.poll_rate_hz,
      1e-3 * static_cast<double>(motor.response_timeout.count()),
      degrees(motor.homing_search_rad_s), degrees(motor.homing_edge_rad_s), motor.homing_timeout_s);
  text += fmt::format(
      "camera:\n  address: \"{}\"\n  pixel_format: {}\n  stamp_offset_s: {}\n"
      "  frame_timeout_s: {}\n  connect_timeout_s: {}\n  packet_bytes: {}\n"
      "  packet_delay_s: {}\n  exposure_s: {}\n  gain_db: {}\n",
      config.camera.address, NameOf(kPixelFormats, config.camera.format),
      config.camera.stamp_offset_s, config.camera.frame_timeout_s, config.camera.connect_timeout_s,
      config.camera.packet_bytes, config.camera.packet_delay_s, config.exposure.exposure_s,
      config.exposure.gain_db);
  text += fmt::format(
      "capture:\n  settle_s: {}\n  travel_speed_deg_s: {:.10g}\n  lidar_timeout_s: {}\n"
      "  camera_timeout_s: {}\n  operator_timeout_s: {}\n",
      config.capture.settle_s, degrees(config.capture.travel_speed_rad_s),
      config.capture.lidar_timeout_s, config.capture.camera_timeout_s,
      config.capture.operator_timeout_s);
  return text;
}

Status SaveHeadConfig(const HeadConfig& config, const std::filesystem::path& path) {
  FORESIGHT_CHECK(ResolveOutput(path));  // before there is a rig beside what is no file
  std::filesystem::path rig = path;
  rig.replace_extension(".rig.yaml");
  FORESIGHT_CHECK(SaveSensorRig(config.rig, rig));
  return WriteFileAtomically(path, HeadConfigToYaml(config, rig.filename().string()));
}

}  // namespace foresight
