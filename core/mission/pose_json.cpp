#include "core/mission/pose_json.h"

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "core/detection/json_values.h"
#include "core/detection/object_json.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Invalid = std::invalid_argument;

constexpr double kAnyNumber = std::numeric_limits<double>::max();

Json JsonOf(const ValveParameters& valve) {
  Json value = ToJson(valve.model);
  value["phase_observable"] = valve.phase_observable;
  return value;
}

Json JsonOf(const DrillParameters& drill) {
  Json value = ToJson(drill.model);
  value.erase("parts");
  return value;
}

Json JsonOf(const SurfaceParameters& surface) {
  return {{"kind", ToString(surface.kind)},
          {"size_m", ToJson(surface.size_m)},
          {"toehold_size_m", ToJson(surface.toehold_size_m)},
          {"slope_rad", surface.slope_rad},
          {"step_m", surface.step_m ? Json(*surface.step_m) : Json(nullptr)}};
}

Json JsonOf(const HandleParameters& handle) {
  return ToJson(handle.model);
}

Json JsonOf(const CylinderParameters& cylinder) {
  return {{"radius_m", cylinder.model.radius_m}, {"length_m", cylinder.model.length_m}};
}

/// A list of exactly `count` numbers.
std::vector<double> NumbersIn(const Json& object, const char* key, std::size_t count) {
  const Json& list = ListIn(object, key, count);
  std::vector<double> numbers;
  for (const Json& value : list) {
    if (!value.is_number()) break;
    numbers.push_back(value.get<double>());
  }
  if (numbers.size() != count) throw Invalid(fmt::format("'{}' is not {} numbers", key, count));
  return numbers;
}

Eigen::Vector2d PairIn(const Json& object, const char* key) {
  return Eigen::Vector2d(NumbersIn(object, key, 2).data());
}

std::string TextIn(const Json& object, const char* key) {
  const Json& value = object.at(key);
  if (!value.is_string()) throw Invalid(fmt::format("'{}' is not text", key));
  return value.get<std::string>();
}

bool FlagIn(const Json& object, const char* key) {
  const Json& value = object.at(key);
  if (!value.is_boolean()) throw Invalid(fmt::format("'{}' is not true or false", key));
  return value.get<bool>();
}

/// A whole number from 0 on.
std::int64_t CountFrom(const Json& object, const char* key) {
  const Json& value = object.at(key);
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost)
    throw Invalid(fmt::format("'{}' is not a whole number from 0 on", key));
  return value.get<std::int64_t>();
}

/// The one of `values` that a member names.
template <class Value, std::size_t kCount>
Value OneIn(const Json& object, const char* key, const std::array<Value, kCount>& values) {
  const std::string name = TextIn(object, key);
  for (const Value value : values)
    if (name == ToString(value)) return value;
  throw Invalid(fmt::format("'{}' is not known", key));
}

ValveParameters ValveParametersFrom(const Json& value) {
  // Old records may be without these; a message is not.
  (void)TextIn(value, "kind");
  (void)SizeIn(value, "lever_length_m");
  return {ValveModelFrom(value), FlagIn(value, "phase_observable")};
}

DrillParameters DrillParametersFrom(const Json& value) {
  Json model = value;
  model["parts"] = Json::array();
  (void)PairIn(model, "body_tilt_rad");  // two numbers, and no null
  return {DrillModelFrom(model)};
}

SurfaceParameters SurfaceParametersFrom(const Json& value) {
  SurfaceParameters surface{SurfaceKindFrom(TextIn(value, "kind")), PairIn(value, "size_m"),
                            PairIn(value, "toehold_size_m"),
                            NumberIn(value, "slope_rad", 0.0, std::numbers::pi), std::nullopt};
  if (!value.at("step_m").is_null())
    surface.step_m = NumberIn(value, "step_m", -kAnyNumber, kAnyNumber);
  return surface;
}

ObjectParameters ParametersFrom(ObjectKind kind, const Json& value) {
  switch (kind) {
    case ObjectKind::kValve:
      return ValveParametersFrom(value);
    case ObjectKind::kDrill:
      return DrillParametersFrom(value);
    case ObjectKind::kHandle:
      return HandleParameters{HandleModelFrom(value)};
    case ObjectKind::kCylinder:
      return CylinderParameters{CylinderModelFrom(value)};
    case ObjectKind::kTerrain:
      break;
  }
  return SurfaceParametersFrom(value);
}

std::optional<PoseCovariance> PoseCovarianceIn(const Json& object) {
  if (object.at("covariance").is_null()) return std::nullopt;
  const Json& rows = ListIn(object, "covariance", 6);
  if (rows.size() != 6) throw Invalid("'covariance' is not 6 rows of 6 numbers");
  PoseCovariance covariance;
  for (std::size_t row = 0; row < 6; ++row) {
    const std::vector<double> numbers = NumbersIn({{"covariance", rows[row]}}, "covariance", 6);
    covariance.row(static_cast<Eigen::Index>(row)) =
        Eigen::Map<const Eigen::RowVectorXd>(numbers.data(), 6);
  }
  return covariance;
}

/// "UUID/sending".
void ReadId(const std::string& id, PoseMessage& message) {
  const std::size_t slash = id.find('/');
  const std::string digits = slash == std::string::npos ? "" : id.substr(slash + 1);
  const bool fits = !digits.empty() && digits.size() <= 7 && digits[0] != '0' &&
                    digits.find_first_not_of("0123456789") == std::string::npos;
  if (!fits) throw Invalid("'id' is not an object's UUID, '/', and the number of the sending");
  message.detection_uuid = id.substr(0, slash);
  message.sending = std::stoi(digits);
}

void ReadPose(const Json& value, PoseMessage& message) {
  message.frame =
      OneIn(value, "frame", std::array{PoseMessage::Frame::kRobot, PoseMessage::Frame::kBase});
  message.position_m = Eigen::Vector3d(NumbersIn(value, "position_m", 3).data());
  const std::vector<double> q = NumbersIn(value, "quaternion_wxyz", 4);
  message.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  message.covariance = PoseCovarianceIn(value);
}

PoseMessage MessageFrom(const Json& value) {
  if (const int version = IntegerIn(value, "version", 1, std::numeric_limits<int>::max());
      version != kPoseMessageVersion)
    throw Invalid(fmt::format("version {} is not known; this program reads {}", version,
                              kPoseMessageVersion));
  PoseMessage message;
  ReadId(TextIn(value, "id"), message);
  message.parameters = ParametersFrom(OneIn(value, "object", kObjectKinds), value.at("parameters"));
  ReadPose(value, message);
  message.verdict =
      OneIn(value, "verdict",
            std::array{VerdictLevel::kConfirmed, VerdictLevel::kLikely, VerdictLevel::kUnsure});
  if (!value.at("probability").is_null())
    message.probability = NumberIn(value, "probability", 0.0, 1.0);
  message.candidate = IntegerIn(value, "candidate", 0, std::numeric_limits<int>::max());
  message.is_winner = FlagIn(value, "is_winner");
  message.decision = OneIn(value, "decision",
                           std::array{Decision::kOpen, Decision::kAccepted, Decision::kRejected});
  message.decided_by = TextIn(value, "decided_by");
  message.origin =
      OneIn(value, "origin", std::array{PoseMessage::Origin::kLive, PoseMessage::Origin::kReview});
  message.simulated = FlagIn(value, "simulated");
  message.scan_uuid = TextIn(value, "scan");
  message.scan_begin_utc_ns = CountFrom(value, "scan_begin_utc_ns");
  message.rig_id = TextIn(value, "rig");
  message.age_s = NumberIn(value, "age_s", 0.0, kAnyNumber);
  return message;
}

}  // namespace

std::string PoseMessageToJson(const PoseMessage& message) {
  const Eigen::Quaterniond& q = message.rotation;
  const OrderedJson value = {
      {"version", kPoseMessageVersion},
      {"id", message.Id()},
      {"object", ToString(ObjectKindOf(message))},
      {"parameters",
       std::visit([](const auto& known) { return JsonOf(known); }, message.parameters)},
      {"frame", ToString(message.frame)},
      {"position_m", ToJson(message.position_m)},
      {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
      {"covariance", message.covariance ? ToJson(*message.covariance) : Json(nullptr)},
      {"verdict", ToString(message.verdict)},
      {"probability", message.probability ? Json(*message.probability) : Json(nullptr)},
      {"candidate", message.candidate},
      {"is_winner", message.is_winner},
      {"decision", ToString(message.decision)},
      {"decided_by", message.decided_by},
      {"origin", ToString(message.origin)},
      {"simulated", message.simulated},
      {"scan", message.scan_uuid},
      {"scan_begin_utc_ns", message.scan_begin_utc_ns},
      {"rig", message.rig_id},
      {"age_s", message.age_s}};
  // A name may hold bytes that are no UTF-8; JSON may not.
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

Result<PoseMessage> PoseMessageFromJson(std::string_view json) {
  if (json.size() > kLongestPoseMessage_bytes)
    return Fail(ErrorCode::kBadData, "pose: {} bytes, more than {}", json.size(),
                kLongestPoseMessage_bytes);
  try {
    PoseMessage message = MessageFrom(ParseJson(json));
    if (const Status sound = CheckPoseMessage(message); !sound)
      return Fail(ErrorCode::kBadData, "pose: {}", sound.error().message);
    return message;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "pose: {}", failure.what());
  }
}

}  // namespace foresight
