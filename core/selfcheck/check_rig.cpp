#include "core/selfcheck/check_rig.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

using State = RigFinding::State;

State StateOf(const RigFinding& finding, double sigmas, double seen_sigmas) {
  if (!std::isfinite(finding.value) || !(finding.sigma * seen_sigmas < finding.limit))
    return State::kNotSeen;
  const double size = std::abs(finding.value);
  return size > finding.limit && size > sigmas * finding.sigma ? State::kDrifted : State::kFine;
}

std::string Amount(const RigFinding& finding, double value) {
  if (finding.unit == "rad") return fmt::format("{:.2f} deg", DegreesFromRadians(value));
  if (finding.unit == "m") return fmt::format("{:.1f} mm", 1000.0 * value);
  if (finding.unit == "1") return fmt::format("{:.2f} %", 100.0 * value);
  if (finding.unit == "s") return fmt::format("{:.1f} ms", 1000.0 * value);
  return fmt::format("{:.2f} {}", value, finding.unit);
}

std::string AmountInWords(const RigFinding& finding) {
  if (!std::isfinite(finding.value)) return "not measured";
  return fmt::format("{} +- {}, the limit is {}", Amount(finding, finding.value),
                     Amount(finding, finding.sigma), Amount(finding, finding.limit));
}

class Judge {
 public:
  Judge(const SensorRig& rig, const Result<PlateCheck>& plate, const Result<CameraCheck>& camera,
        const Result<TurnCheck>& turns, const Result<PassCheck>& passes,
        const RigCheckLimits& limits)
      : rig_(rig), limits_(limits) {
    if (plate)
      check_.plate = *plate;
    else
      check_.no_plate = plate.error().message;
    if (camera)
      check_.camera = *camera;
    else
      check_.no_camera = camera.error().message;
    if (turns)
      check_.turns = *turns;
    else
      check_.no_turns = turns.error().message;
    if (passes)
      check_.passes = *passes;
    else
      check_.no_passes = passes.error().message;
  }

  RigCheck Run() {
    JudgeCamera();
    JudgeLidar();
    JudgeStamps();
    JudgeTurns();
    SayWhatMoved();
    SayWhatIsNotSeen();
    return std::move(check_);
  }

 private:
  void Add(RigFinding finding) {
    finding.state = StateOf(finding, limits_.sigmas, limits_.seen_sigmas);
    check_.findings.push_back(std::move(finding));
  }

  void JudgeCamera() {
    for (int axis = 0; axis < 3; ++axis) {
      RigFinding finding;
      finding.name = fmt::format("camera turn {}", "xyz"[axis]);
      finding.in_words =
          fmt::format("camera against lidar, about the camera's {} axis", "xyz"[axis]);
      finding.unit = "rad";
      const double along = std::abs(rig_.camera_from_head.Rotate(Eigen::Vector3d::UnitX())[axis]);
      finding.limit = limits_.camera_turn_rad +
                      along * (limits_.camera_turn_along_motor_rad - limits_.camera_turn_rad);
      finding.value = finding.sigma = std::nan("");
      if (check_.camera) {
        finding.value = check_.camera->turn_rad[axis];
        finding.sigma = check_.camera->Sigma(axis);
      }
      Add(finding);
      RigFinding& added = check_.findings.back();
      if (added.state == State::kDrifted && !FitsBetter(*check_.camera))
        added.state = State::kNotSeen;
    }
  }

  bool FitsBetter(const CameraCheck& camera) const {
    return camera.gain_sigmas >= limits_.least_gain_sigmas &&
           camera.GainOfContrast() >= LeastGainOfContrast();
  }

  double LeastGainOfContrast() const {
    return limits_.least_gain_of_contrast / std::sqrt(check_.camera->scans);
  }

  void JudgeLidar() {
    for (const auto unknown : {PlateCheck::kTurnY, PlateCheck::kTurnZ}) {
      const char axis = unknown == PlateCheck::kTurnY ? 'y' : 'z';
      RigFinding finding;
      finding.name = fmt::format("lidar turn {}", axis);
      finding.in_words = fmt::format("lidar against the motor, about the head's {} axis", axis);
      finding.unit = "rad";
      finding.limit = limits_.lidar_turn_rad;
      finding.value = finding.sigma = std::nan("");
      if (check_.plate) {
        finding.value = check_.plate->drift[unknown];
        finding.sigma = check_.plate->Sigma(unknown);
      }
      Add(finding);
    }
  }

  void JudgeStamps() {
    RigFinding finding;
    finding.name = "stamps";
    finding.in_words = "the lidar's stamps against the encoder's";
    finding.unit = "s";
    finding.value = finding.sigma = finding.limit = std::nan("");
    if (check_.passes) {
      finding.limit = 0.5 * limits_.stamp_turn_rad / check_.passes->speed_rad_s;
      finding.value = check_.passes->stamp_s;
      finding.sigma = check_.passes->sigma_s;
    }
    Add(finding);
  }

  void JudgeTurns() {
    AddTurn(TurnCheck::kCameraY, "camera on plate y",
            "camera against the motor, about the head's y axis", "rad",
            limits_.camera_on_plate_rad);
    AddTurn(TurnCheck::kCameraZ, "camera on plate z",
            "camera against the motor, about the head's z axis", "rad",
            limits_.camera_on_plate_rad);
    AddTurn(TurnCheck::kScale, "motor scale",
            "how far the plate turns, against what the motor says", "1", limits_.motor_scale);
    AddTurn(TurnCheck::kBend, "motor bend", "the plate halfway between the outermost images", "rad",
            limits_.motor_bend_rad);
  }

  void AddTurn(TurnCheck::Unknown unknown, const char* name, const char* in_words, const char* unit,
               double limit) {
    RigFinding finding;
    finding.name = name;
    finding.in_words = in_words;
    finding.unit = unit;
    finding.limit = limit;
    finding.value = finding.sigma = std::nan("");
    if (check_.turns && (unknown != TurnCheck::kBend || check_.turns->bend_seen)) {
      finding.value = check_.turns->drift[unknown];
      finding.sigma = check_.turns->Sigma(unknown);
    }
    Add(finding);
  }

  const RigFinding& Finding(const std::string& name) const {
    return *std::find_if(check_.findings.begin(), check_.findings.end(),
                         [&](const RigFinding& f) { return f.name == name; });
  }

  void SayWhatMoved() {
    for (const RigFinding& finding : check_.findings)
      if (finding.state == State::kDrifted) check_.drifted.push_back(InWords(finding));
    const bool camera_drifted =
        std::any_of(check_.findings.begin(), check_.findings.begin() + 3,
                    [](const RigFinding& f) { return f.state == State::kDrifted; });
    if (camera_drifted) check_.drifted.push_back(WhichOfBoth());
  }

  /// Edges say how camera and lidar stand to each other, planes how the lidar stands to the motor.
  std::string WhichOfBoth() const {
    const State on_plate_y = Finding("camera on plate y").state,
                on_plate_z = Finding("camera on plate z").state;
    const State about_y = Finding("lidar turn y").state, about_z = Finding("lidar turn z").state;
    const bool camera_moved = on_plate_y == State::kDrifted || on_plate_z == State::kDrifted;
    const bool lidar_moved = about_y == State::kDrifted || about_z == State::kDrifted;
    if (camera_moved && lidar_moved) return "both camera and lidar moved against the motor";
    if (camera_moved) return "the camera moved against the motor: it is the camera that turned";
    if (lidar_moved) return "the lidar moved against the motor: it is the lidar that turned";
    const Eigen::Vector3d in_head = rig_.camera_from_head.Inverse().Rotate(check_.camera->turn_rad);
    if (std::abs(in_head.x()) > in_head.tail<2>().norm())
      return "which of both turned does not show: planes do not tell a turn about the motor's axis";
    if (about_y == State::kFine && about_z == State::kFine)
      return "the lidar still fits the motor: it is the camera that turned";
    if (on_plate_y == State::kFine && on_plate_z == State::kFine)
      return "the camera still fits the motor: it is the lidar that turned";
    return "which of both turned does not show in this scan";
  }

  void SayWhatIsNotSeen() {
    std::vector<std::string>& list = check_.cannot_see;
    if (!check_.no_camera.empty())
      list.push_back("camera against lidar: " + check_.no_camera);
    else
      SayNotSeen("camera turn", "more depth edges at other places of the image show it");
    if (!check_.no_plate.empty())
      list.push_back("lidar against the motor: " + check_.no_plate);
    else
      SayNotSeen("lidar turn", "walls at several angles, floor and ceiling show it");
    if (!check_.no_passes.empty())
      list.push_back("the lidar's stamps against the encoder's: " + check_.no_passes);
    else
      SayNotSeen("stamps", "a faster sweep before floor, ceiling or sloping surfaces shows it");
    if (!check_.no_turns.empty())
      list.push_back("camera against the motor, and how far the plate turns: " + check_.no_turns);
    else
      for (const char* start : {"camera on plate", "motor"})
        SayNotSeen(start, "three images, farther apart, where surfaces have a pattern, show it");
    list.emplace_back(
        "the motor's zero and the robot's frame: camera and lidar turn together with the plate; "
        "compare with something whose place the robot knows");
    list.emplace_back("the camera's lens: only boards show it");
  }

  void SayNotSeen(const std::string& start, const char* hint) {
    for (const RigFinding& finding : check_.findings)
      if (finding.state == State::kNotSeen && finding.name.starts_with(start))
        check_.cannot_see.push_back(fmt::format("{}: {}; {}", finding.in_words,
                                                AmountInWords(finding),
                                                IsDoubted(finding) ? WhyItIsDoubted() : hint));
  }

  /// Measured well enough and more than the limit, and still not believed.
  bool IsDoubted(const RigFinding& finding) const {
    return StateOf(finding, limits_.sigmas, limits_.seen_sigmas) == State::kDrifted;
  }

  std::string WhyItIsDoubted() const {
    const CameraCheck& camera = *check_.camera;
    return fmt::format(
        "with it the edges stand out by {:.0f} % more, {:.1f} deviations, where {:.0f} % and "
        "{:.1f} "
        "are believed; more scans together show it",
        100.0 * camera.GainOfContrast(), camera.gain_sigmas, 100.0 * LeastGainOfContrast(),
        limits_.least_gain_sigmas);
  }

  const SensorRig& rig_;
  const RigCheckLimits& limits_;
  RigCheck check_;
};

}  // namespace

const char* ToString(RigFinding::State state) {
  switch (state) {
    case State::kFine:
      return "fine";
    case State::kDrifted:
      return "drifted";
    case State::kNotSeen:
      return "not seen";
  }
  return "";
}

std::string InWords(const RigFinding& finding) {
  return fmt::format("{}: off by {}", finding.in_words, AmountInWords(finding));
}

bool RigCheck::SawAnything() const {
  return std::any_of(findings.begin(), findings.end(),
                     [](const RigFinding& f) { return f.state != State::kNotSeen; });
}

RigCheck JudgeRig(const SensorRig& rig, const Result<PlateCheck>& plate,
                  const Result<CameraCheck>& camera, const Result<TurnCheck>& turns,
                  const Result<PassCheck>& passes, const RigCheckLimits& limits) {
  return Judge(rig, plate, camera, turns, passes, limits).Run();
}

Result<RigCheck> CheckRig(const Scan& scan, const RigCheckOptions& options,
                          const RunContext& context) {
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(scan, context.Part(0.0, 0.1)));
  return CheckRig(scan, cloud, options, context.Part(0.1, 1.0));
}

Result<RigCheck> CheckRig(const Scan& scan, const RegisteredScan& cloud,
                          const RigCheckOptions& options, const RunContext& context) {
  Result<PlateCheck> plate = Fail(ErrorCode::kTooFewPoints,
                                  "the scan was imported: its points were placed elsewhere, and no "
                                  "motor's angle is known of them");
  CameraCheckOptions camera_options = options.camera;
  RigCheckLimits limits = options.limits;
  Result<TurnCheck> turns = tl::unexpected(plate.error());
  Result<PassCheck> passes = tl::unexpected(plate.error());
  if (scan.given.empty()) {
    plate = CheckPlate(scan, cloud, options.plate);
    passes = CheckPasses(scan, cloud, options.passes);
    turns = CheckTurns(scan, cloud, options.turns, context.Part(0.1, 0.2));
  } else {
    camera_options.edges = DepthEdgeOptions::OfImported();
    limits.camera_turn_along_motor_rad = limits.camera_turn_rad;  // no motor of ours turned it
  }
  const auto camera = CheckCamera(scan, cloud, camera_options, context.Part(0.2, 1.0));
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the check was cancelled");
  return JudgeRig(scan.rig, plate, camera, turns, passes, limits);
}

}  // namespace foresight
