#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/printable.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/mission/pose_message.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

constexpr double kFarthest_m = 100'000.0;
constexpr double kLargestSurface_m = 1000.0;
constexpr double kOldest_s = 1e9;
constexpr double kLargestVariance = 1e6;  ///< a kilometre's
constexpr std::size_t kLongestName_bytes = 200;
constexpr int kMostSendings = 1'000'000;
constexpr int kMostCandidates = 10'000;

Status In(const char* member, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return Fail(ErrorCode::kBadData, "'{}' is {}, not {} to {}", member, value, low, high);
}

/// What files and tables may be named after: letters, digits, '-', '_' and '.'.
Status CheckUuid(const char* member, const std::string& uuid) {
  constexpr std::size_t kLongest = 100;
  const bool fits =
      !uuid.empty() && uuid.size() <= kLongest && std::all_of(uuid.begin(), uuid.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
               c == '-' || c == '_' || c == '.';
      });
  if (fits) return {};
  return Fail(ErrorCode::kBadData, "'{}' is '{}', not 1 to {} letters, digits, '-', '_' or '.'",
              member, Printable(uuid.substr(0, kLongest)), kLongest);
}

Status CheckName(const char* member, const std::string& name) {
  if (name.size() <= kLongestName_bytes && Printable(name) == name) return {};
  return Fail(ErrorCode::kBadData, "'{}' is not one line of at most {} bytes of UTF-8", member,
              kLongestName_bytes);
}

Status CheckVector(const char* member, const Eigen::Ref<const Eigen::VectorXd>& vector, double low,
                   double high) {
  for (const double value : vector) FORESIGHT_CHECK(In(member, value, low, high));
  return {};
}

Status CheckModel(const auto& model) {
  const Status sound = model.Check();
  if (sound) return {};
  return Fail(ErrorCode::kBadData, "'parameters': {}", sound.error().message);
}

Status CheckParameters(const ValveParameters& valve) {
  return CheckModel(valve.model);
}

Status CheckParameters(const HandleParameters& handle) {
  return CheckModel(handle.model);
}

Status CheckParameters(const CylinderParameters& cylinder) {
  return CheckModel(cylinder.model);
}

Status CheckParameters(const DrillParameters& drill) {
  FORESIGHT_CHECK(CheckName("template", drill.model.template_name));
  return CheckVector("body_tilt_rad", drill.model.body_tilt_rad, -std::numbers::pi,
                     std::numbers::pi);
}

Status CheckParameters(const SurfaceParameters& surface) {
  FORESIGHT_CHECK(CheckVector("size_m", surface.size_m, 0.0, kLargestSurface_m));
  FORESIGHT_CHECK(CheckVector("toehold_size_m", surface.toehold_size_m, 0.0, kLargestSurface_m));
  FORESIGHT_CHECK(In("slope_rad", surface.slope_rad, 0.0, std::numbers::pi));
  if (surface.step_m)
    FORESIGHT_CHECK(In("step_m", *surface.step_m, -kLargestSurface_m, kLargestSurface_m));
  return {};
}

Status CheckCovariance(const PoseCovariance& covariance) {
  // Of what is computed with 53 bits and comes through text unchanged.
  constexpr double kRounding = 1e-9;
  FORESIGHT_CHECK(
      CheckVector("covariance", covariance.reshaped(), -kLargestVariance, kLargestVariance));
  FORESIGHT_CHECK(CheckVector("covariance", covariance.diagonal(), 0.0, kLargestVariance));
  // Metres and radians are made comparable: each direction by its own deviation.
  const Eigen::Matrix<double, 6, 1> scale =
      covariance.diagonal().unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 1.0; });
  const PoseCovariance correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  if (!((correlation - correlation.transpose()).cwiseAbs().maxCoeff() <= kRounding))
    return Fail(ErrorCode::kBadData, "'covariance' is not symmetric");
  const double least = EigenOf(correlation).values.minCoeff();
  if (least >= -kRounding) return {};
  return Fail(ErrorCode::kBadData, "'covariance' is not positive semi-definite");
}

Status CheckPose(const PoseMessage& message) {
  constexpr double kUnit = 1e-6;
  FORESIGHT_CHECK(CheckVector("position_m", message.position_m, -kFarthest_m, kFarthest_m));
  if (!(std::abs(message.rotation.norm() - 1.0) <= kUnit))
    return Fail(ErrorCode::kBadData, "'quaternion_wxyz' has length {}, not 1",
                message.rotation.norm());
  if (message.covariance) FORESIGHT_CHECK(CheckCovariance(*message.covariance));
  return {};
}

}  // namespace

Status CheckPoseMessage(const PoseMessage& message) {
  FORESIGHT_CHECK(CheckUuid("id", message.detection_uuid));
  FORESIGHT_CHECK(In("id", message.sending, 1, kMostSendings));
  FORESIGHT_CHECK(
      std::visit([](const auto& known) { return CheckParameters(known); }, message.parameters));
  FORESIGHT_CHECK(CheckPose(message));
  if (message.probability) FORESIGHT_CHECK(In("probability", *message.probability, 0.0, 1.0));
  FORESIGHT_CHECK(In("candidate", message.candidate, 0, kMostCandidates));
  FORESIGHT_CHECK(CheckName("decided_by", message.decided_by));
  FORESIGHT_CHECK(CheckUuid("scan", message.scan_uuid));
  if (message.scan_begin_utc_ns < 0)
    return Fail(ErrorCode::kBadData, "'scan_begin_utc_ns' is {}, before 1970",
                message.scan_begin_utc_ns);
  if (const Status rig = CheckRigId(message.rig_id); !rig)
    return Fail(ErrorCode::kBadData, "'rig': {}", rig.error().message);
  return In("age_s", message.age_s, 0.0, kOldest_s);
}

}  // namespace foresight
