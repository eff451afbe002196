#include "core/mission/pose_message.h"

#include <algorithm>
#include <numbers>

#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

constexpr int kAlong = 2;  ///< row of the move along the object's z
constexpr int kPhase = 5;  ///< ... and of the turn about it
constexpr double kVarianceOfAnyAngle = std::numbers::pi * std::numbers::pi / 3.0;

DrillParameters WithoutParts(DrillModel model) {
  model.parts.clear();
  return {std::move(model)};
}

SurfaceParameters ParametersOf(const TerrainSurface& surface) {
  SurfaceParameters parameters{surface.kind, surface.size_m, surface.toehold.size_m,
                               surface.toehold.slope_rad, std::nullopt};
  if (std::isfinite(surface.toehold.step_m)) parameters.step_m = surface.toehold.step_m;
  return parameters;
}

/// What differs between the kinds; `candidate` is one that is there.
void Describe(const ValveDetection& valve, std::size_t candidate, PoseMessage& message) {
  const ValveCandidate& chosen = candidate == 0 ? valve.best : valve.alternatives[candidate - 1];
  message.parameters = ValveParameters{chosen.model, valve.phase_observable};
  if (candidate > 0) return;
  message.covariance = valve.covariance;
  if (valve.phase_observable) return;
  // Every direction of x is as good as another: the variance of an angle that may be any.
  message.covariance->row(kPhase).setZero();
  message.covariance->col(kPhase).setZero();
  (*message.covariance)(kPhase, kPhase) = kVarianceOfAnyAngle;
}

void Describe(const DrillDetection& drill, std::size_t candidate, PoseMessage& message) {
  const DrillCandidate& chosen = candidate == 0 ? drill.best : drill.alternatives[candidate - 1];
  message.parameters = WithoutParts(chosen.model);
  if (candidate == 0) message.covariance = drill.covariance;
}

void Describe(const HandleDetection& handle, std::size_t candidate, PoseMessage& message) {
  const HandleCandidate& chosen = candidate == 0 ? handle.best : handle.alternatives[candidate - 1];
  message.parameters = HandleParameters{chosen.model};
  if (candidate == 0) message.covariance = handle.covariance;
}

void Describe(const CylinderDetection& cylinder, std::size_t, PoseMessage& message) {
  message.parameters = CylinderParameters{cylinder.model};
  message.probability.reset();
  message.covariance = cylinder.covariance;
  for (const int i : {kAlong, kPhase}) {
    message.covariance->row(i).setZero();
    message.covariance->col(i).setZero();
  }
  // Its middle may be anywhere along what was seen, as it may go on; and x may point anywhere.
  const double length_m = cylinder.model.length_m;
  (*message.covariance)(kAlong, kAlong) = length_m * length_m / 12.0;
  (*message.covariance)(kPhase, kPhase) = kVarianceOfAnyAngle;
}

void Describe(const TerrainDetection& terrain, std::size_t candidate, PoseMessage& message) {
  const TerrainSurface& surface = terrain.surfaces[candidate];
  message.parameters = ParametersOf(surface);
  message.covariance = surface.covariance;
  message.probability = surface.verdict.probability;
}

/// To the last bit symmetric; none where a part of it is not known.
std::optional<PoseCovariance> Known(const std::optional<PoseCovariance>& covariance) {
  if (!covariance || !covariance->allFinite()) return std::nullopt;
  return PoseCovariance(0.5 * (*covariance + covariance->transpose()));
}

void SetPose(const Rigid<frame::Base, frame::Object>& base_from_object, const SensorRig& rig,
             PoseMessage& message) {
  message.position_m = base_from_object.translation();
  message.rotation = base_from_object.rotation();
  if (rig.robot_frame_source == RobotFrameSource::kUnknown) return;
  const auto robot_from_object = rig.robot_from_base * base_from_object;
  message.frame = PoseMessage::Frame::kRobot;
  message.position_m = robot_from_object.translation();
  message.rotation = robot_from_object.rotation();
}

}  // namespace

std::string PoseMessage::Id() const {
  return fmt::format("{}/{}", detection_uuid, sending);
}

const char* ToString(PoseMessage::Frame frame) {
  return frame == PoseMessage::Frame::kRobot ? "robot" : "base";
}

const char* ToString(PoseMessage::Origin origin) {
  return origin == PoseMessage::Origin::kLive ? "live" : "review";
}

ObjectKind ObjectKindOf(const PoseMessage& message) {
  return kObjectKinds[message.parameters.index()];
}

Result<PoseMessage> PoseMessageOf(const Detection& detection, int candidate, const SensorRig& rig,
                                  const PoseContext& context) {
  const int count = CandidateCount(detection);
  if (candidate < 0 || candidate >= count)
    return Fail(ErrorCode::kInvalidInput, "object {}: no answer {}; it has {}, counted from 0",
                context.detection_uuid, candidate, count);
  PoseMessage message;
  message.detection_uuid = context.detection_uuid;
  message.sending = context.sending;
  message.candidate = candidate;
  message.is_winner = candidate == 0 || std::holds_alternative<TerrainDetection>(detection);
  message.verdict = CandidateLevel(detection, candidate);
  if (message.is_winner) message.probability = VerdictOf(detection).probability;
  std::visit(
      [&](const auto& found) { Describe(found, static_cast<std::size_t>(candidate), message); },
      detection);
  message.covariance = Known(message.covariance);
  SetPose(CandidatePose(detection, candidate), rig, message);
  message.decision = context.decision;
  message.decided_by = context.decided_by;
  message.origin = context.origin;
  message.simulated = context.simulated;
  message.scan_uuid = context.scan_uuid;
  message.scan_begin_utc_ns = context.scan_begin_utc_ns;
  message.rig_id = RigId(rig);
  message.age_s = context.age_s;
  return message;
}

Result<PoseMessage> PoseMessageOf(const DetectionRecord& record, int candidate,
                                  const SensorRig& rig, const ScanSummary& scan,
                                  std::int64_t now_utc_ns) {
  if (scan.imported)
    return Fail(ErrorCode::kInvalidInput,
                "detection {}: its scan was imported ({}): no robot gets a pose of it", record.id,
                scan.source);
  FORESIGHT_TRY(const Detection detection, DetectionFromJson(record.json));
  PoseContext context;
  context.detection_uuid = record.uuid;
  // A decision is about one answer: the others are open.
  if (candidate == record.decided_candidate) {
    context.decision = record.decision;
    context.decided_by = record.decided_by;
  }
  context.simulated = scan.simulated;
  context.scan_uuid = scan.uuid;
  context.scan_begin_utc_ns = scan.begin_utc_ns;
  context.age_s =
      1e-9 * static_cast<double>(std::max<std::int64_t>(0, now_utc_ns - scan.begin_utc_ns));
  return PoseMessageOf(detection, candidate, rig, context);
}

}  // namespace foresight
