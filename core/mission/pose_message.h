#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/base/result.h"
#include "core/detection/detection.h"
#include "core/mission/mission_records.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// What a robot is told of a valve, a drill, a surface, a door handle and a cylinder beside its
/// pose.
struct ValveParameters {
  ValveModel model;
  bool phase_observable = true;  ///< false: the direction of x means nothing (a disc)
};
struct DrillParameters {
  DrillModel model;  ///< without its parts
};
struct SurfaceParameters {
  TerrainSurface::Kind kind = TerrainSurface::Kind::kUnknown;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< along x and y
  Eigen::Vector2d toehold_size_m = Eigen::Vector2d::Zero();
  double slope_rad = 0.0;
  std::optional<double> step_m;  ///< as Toehold has it; none = not known
};
struct HandleParameters {
  HandleModel model;
};
struct CylinderParameters {
  CylinderModel model;
};
/// In the order of Detection's alternatives.
using ObjectParameters = std::variant<ValveParameters, DrillParameters, SurfaceParameters,
                                      HandleParameters, CylinderParameters>;

/// A pose on its way to the robot (docs/protocols.md, "To the robot").
struct PoseMessage {
  enum class Frame { kRobot, kBase };
  enum class Origin { kLive, kReview };

  std::string detection_uuid;
  int sending = 1;  ///< of this detection, counted from 1: a repeat has the same one
  ObjectParameters parameters;
  Frame frame = Frame::kBase;  ///< of the pose: kRobot where the rig knows how the head is mounted
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< object to frame
  std::optional<PoseCovariance> covariance;                      ///< none = not known
  VerdictLevel verdict = VerdictLevel::kUnsure;                  ///< of the candidate
  /// That the pose is right; none for an alternative, and where none was calibrated.
  std::optional<double> probability;
  int candidate = 0;      ///< which answer: 0 = the best; of a terrain, which surface
  bool is_winner = true;  ///< false: an alternative to the best answer
  Decision decision = Decision::kOpen;
  std::string decided_by;  ///< empty where nothing was decided
  Origin origin = Origin::kReview;
  bool simulated = false;  ///< the scan is
  std::string scan_uuid;
  std::int64_t scan_begin_utc_ns = 0;  ///< first line, by the head's clock
  std::string rig_id;                  ///< of the scan
  double age_s = 0.0;                  ///< since the scan's begin, when the message was sent

  /// "UUID/sending": what makes a repeat harmless.
  std::string Id() const;
};

/// "robot", "base"; "live", "review".
const char* ToString(PoseMessage::Frame frame);
const char* ToString(PoseMessage::Origin origin);
ObjectKind ObjectKindOf(const PoseMessage& message);

/// What a detection does not say itself.
struct PoseContext {
  std::string detection_uuid;
  int sending = 1;
  Decision decision = Decision::kOpen;
  std::string decided_by;
  PoseMessage::Origin origin = PoseMessage::Origin::kReview;
  bool simulated = false;
  std::string scan_uuid;
  std::int64_t scan_begin_utc_ns = 0;
  double age_s = 0.0;
};

/// The message about one candidate of a detection in a scan with this rig. Fails with kInvalidInput
/// where there is no such candidate.
Result<PoseMessage> PoseMessageOf(const Detection& detection, int candidate, const SensorRig& rig,
                                  const PoseContext& context);

/// The same of the best answer of a record, or a terrain's `candidate`, as a file keeps it: a
/// review. The age is that at `now_utc_ns`. Fails also with kBadData, and with kInvalidInput where
/// the scan was imported.
Result<PoseMessage> PoseMessageOf(const DetectionRecord& record, int candidate,
                                  const SensorRig& rig, const ScanSummary& scan,
                                  std::int64_t now_utc_ns);

/// Whether every member is one that a pose can have: finite, in its range, a covariance that is
/// symmetric and positive semi-definite. Fails with kBadData, naming the member and its value.
Status CheckPoseMessage(const PoseMessage& message);

}  // namespace foresight
