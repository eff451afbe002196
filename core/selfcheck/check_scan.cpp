#include "core/selfcheck/check_scan.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/operator_text.h"
#include "core/base/parallel.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

using State = RigFinding::State;

CheckLight LightOf(const RigFinding& finding) {
  switch (finding.state) {
    case State::kNotSeen:
      return CheckLight::kNotSeen;
    case State::kFine:
      return CheckLight::kGood;
    case State::kDrifted:
      return std::abs(finding.value) < kRedLimits * finding.limit ? CheckLight::kAmber
                                                                  : CheckLight::kRed;
  }
  return CheckLight::kNotSeen;
}

CheckLight LightOf(DepthCheck::State state) {
  switch (state) {
    case DepthCheck::State::kGood:
      return CheckLight::kGood;
    case DepthCheck::State::kLessThanPromised:
      return CheckLight::kAmber;
    case DepthCheck::State::kFarLessThanPromised:
      return CheckLight::kRed;
    case DepthCheck::State::kNotSeen:
      return CheckLight::kNotSeen;
  }
  return CheckLight::kNotSeen;
}

CheckLight LightOf(HalfFits::State state) {
  switch (state) {
    case HalfFits::State::kAgree:
      return CheckLight::kGood;
    case HalfFits::State::kDiffer:
      return CheckLight::kAmber;
    case HalfFits::State::kDifferFar:
      return CheckLight::kRed;
    case HalfFits::State::kNotSeen:
      return CheckLight::kNotSeen;
  }
  return CheckLight::kNotSeen;
}

/// The findings whose name begins so.
std::vector<const RigFinding*> Findings(const RigCheck& check, const std::string& start) {
  std::vector<const RigFinding*> found;
  for (const RigFinding& finding : check.findings)
    if (finding.name.starts_with(start)) found.push_back(&finding);
  return found;
}

CheckLight Gravest(const std::vector<const RigFinding*>& findings) {
  CheckLight light = CheckLight::kNotSeen;
  for (const RigFinding* finding : findings) light = std::max(light, LightOf(*finding));
  return light;
}

bool AllSeen(const std::vector<const RigFinding*>& findings) {
  return std::none_of(findings.begin(), findings.end(),
                      [](const RigFinding* finding) { return finding->state == State::kNotSeen; });
}

std::string JoinedSentence(const std::vector<const RigFinding*>& findings) {
  std::string text;
  for (const RigFinding* finding : findings)
    if (finding->state == State::kDrifted) text += (text.empty() ? "" : "; ") + InWords(*finding);
  return text;
}

class ScanJudge {
 public:
  ScanJudge(const SensorRig& rig, const Result<DepthCheck>& depth, const RigCheck& checked,
            const std::vector<HalfFits>& objects)
      : rig_(rig) {
    if (depth)
      check_.depth = *depth;
    else
      check_.no_depth = depth.error().message;
    check_.rig = checked;
    check_.objects = objects;
  }

  ScanCheck Run() {
    JudgeCamera();
    JudgeLidar();
    JudgeStamps();
    JudgeTurns();
    JudgeDepth();
    for (const HalfFits& object : check_.objects) JudgeObject(object);
    check_.cannot_see.insert(check_.cannot_see.end(), check_.rig.cannot_see.begin(),
                             check_.rig.cannot_see.end());
    Advise();
    return std::move(check_);
  }

 private:
  void Add(const std::string& name, CheckLight light, std::string sentence) {
    check_.points.push_back({name, light, std::move(sentence)});
  }

  void JudgeCamera() {
    const auto findings = Findings(check_.rig, "camera turn");
    const CheckLight light = Gravest(findings);
    std::string sentence;
    if (light == CheckLight::kNotSeen) {
      sentence = OperatorText("camera against lidar: not seen");
    } else if (light == CheckLight::kGood) {
      Eigen::Vector2d off_px = EdgesOff_px(rig_, check_.rig);
      // A direction that this scan does not show says nothing.
      if (!Seen("camera turn y")) off_px.x() = 0.0;
      if (!Seen("camera turn x")) off_px.y() = 0.0;
      sentence = OperatorText("image edges lie on the lidar's within {:.1f} px",
                              std::max(0.1, off_px.norm()));
    } else {
      sentence = OperatorText("{}: check the calibration of camera and lidar", WhereEdgesLie());
    }
    Add("camera against lidar", light, std::move(sentence));
  }

  bool Seen(const char* name) const {
    const auto found = Findings(check_.rig, name);
    return !found.empty() && found.front()->state != State::kNotSeen;
  }

  /// "image edges lie 4.1 px left of the lidar's".
  std::string WhereEdgesLie() const {
    const Eigen::Vector2d off_px = EdgesOff_px(rig_, check_.rig);
    const auto drifted = [&](const char* name) {
      const auto found = Findings(check_.rig, name);
      return !found.empty() && found.front()->state == State::kDrifted;
    };
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (drifted("camera turn y"))
      add(off_px.x() > 0.0
              ? OperatorText("image edges lie {:.1f} px right of the lidar's", off_px.x())
              : OperatorText("image edges lie {:.1f} px left of the lidar's", -off_px.x()));
    if (drifted("camera turn x"))
      add(off_px.y() > 0.0
              ? OperatorText("image edges lie {:.1f} px below the lidar's", off_px.y())
              : OperatorText("image edges lie {:.1f} px above the lidar's", -off_px.y()));
    if (drifted("camera turn z")) {
      const double turn_deg = DegreesFromRadians(check_.rig.camera->turn_rad.z());
      add(turn_deg > 0.0
              ? OperatorText("image edges are turned by {:.2f} deg clockwise", turn_deg)
              : OperatorText("image edges are turned by {:.2f} deg anticlockwise", -turn_deg));
    }
    return text;
  }

  void JudgeLidar() {
    const auto findings = Findings(check_.rig, "lidar turn");
    const CheckLight light = Gravest(findings);
    Add("lidar against motor", light,
        light == CheckLight::kNotSeen ? OperatorText("lidar against the motor: not seen")
        : light == CheckLight::kGood
            ? (AllSeen(findings) ? OperatorText("planes are flat: the lidar fits the motor")
                                 : OperatorText("planes are flat, as far as this scan shows them"))
            : OperatorText("planes bend: {}: look whether the lidar is loose, and calibrate again",
                           JoinedSentence(findings)));
  }

  void JudgeStamps() {
    const auto findings = Findings(check_.rig, "stamps");
    const CheckLight light = Gravest(findings);
    Add("stamps", light,
        light == CheckLight::kNotSeen ? OperatorText("clocks: not seen")
        : light == CheckLight::kGood
            ? OperatorText("surfaces lie where they do on the way up and down: the clocks agree")
            : OperatorText("surfaces differ on the way up and down: {}: check the clocks and the "
                           "motor's backlash, and calibrate again",
                           JoinedSentence(findings)));
  }

  void JudgeTurns() {
    auto findings = Findings(check_.rig, "camera on plate");
    for (const RigFinding* finding : Findings(check_.rig, "motor")) findings.push_back(finding);
    const CheckLight light = Gravest(findings);
    Add("camera and motor", light,
        light == CheckLight::kNotSeen ? OperatorText("camera and motor: not seen")
        : light == CheckLight::kGood
            ? OperatorText("the images agree with the motor's angles")
            : OperatorText(
                  "the images do not agree with the motor's angles: {}: look whether the camera is "
                  "loose or the plate slips, and calibrate again",
                  JoinedSentence(findings)));
  }

  void JudgeDepth() {
    if (!check_.depth) {
      check_.cannot_see.push_back("depth: " + check_.no_depth);
      return;
    }
    const DepthCheck& depth = *check_.depth;
    const CheckLight light = LightOf(depth.state);
    std::string sentence = OperatorText(
        "depth is right to {:.0f} mm in 80 % and to {:.0f} mm in 95 % of the places it keeps",
        std::max(1.0, 1000.0 * depth.map_q80_m), std::max(1.0, 1000.0 * depth.map_q95_m));
    if (depth.TooFewBeams())
      sentence = OperatorText(
          "depth: of {} beams held out {} lie where the mask keeps the map, too few to judge it",
          depth.left_out, depth.all.beams);
    if (light >= CheckLight::kAmber)
      sentence = OperatorText(
          "depth that promises to be right in {:.0f} % of the places is right in {:.0f} %: scan "
          "slower or from nearer, and do not rely on single points of it",
          100.0 * depth.promise.promised, 100.0 * depth.promise.right);
    Add("depth", light, std::move(sentence));
  }

  void JudgeObject(const HalfFits& object) {
    const CheckLight light = LightOf(object.state);
    if (light == CheckLight::kNotSeen) check_.cannot_see.push_back(object.not_seen);
    std::string sentence = object.not_seen;
    if (light == CheckLight::kGood)
      sentence = OperatorText("{}: even and odd lines agree ({})", object.what,
                              InWords(object.differences.front()));
    else if (light != CheckLight::kNotSeen)
      sentence = OperatorText(
          "{}: even and odd lines differ {}: rely on it no better than that, or scan again slower",
          object.what, InWords(object.differences.front()));
    Add("object", light, std::move(sentence));
  }

  void Advise() {
    for (const CheckPoint& point : check_.points)
      check_.light = std::max(check_.light, point.light);
    const auto grave =
        std::count_if(check_.points.begin(), check_.points.end(),
                      [](const CheckPoint& point) { return point.light >= CheckLight::kAmber; });
    // Points are in the order of what spoils what: a wrong calibration spoils the rest.
    for (const CheckPoint& point : check_.points)
      if (grave > 0 && point.light == check_.light) {
        check_.advice = point.sentence;
        break;
      }
    if (grave > 1) check_.advice = OperatorText("{} (and {} more)", check_.advice, grave - 1);
    if (grave > 0) return;
    check_.advice = check_.light == CheckLight::kGood
                        ? OperatorText("nothing to do: {}", GoodInWords())
                        : OperatorText(
                              "nothing can be said: scan where walls and things that "
                              "stand before others are in view, with an image");
  }

  std::string GoodInWords() const {
    std::string text;
    for (const CheckPoint& point : check_.points)
      if (point.light == CheckLight::kGood) text += (text.empty() ? "" : "; ") + point.sentence;
    return text;
  }

  const SensorRig& rig_;
  ScanCheck check_;
};

}  // namespace

const char* ToString(CheckLight light) {
  switch (light) {
    case CheckLight::kNotSeen:
      return "not seen";
    case CheckLight::kGood:
      return "good";
    case CheckLight::kAmber:
      return "amber";
    case CheckLight::kRed:
      return "red";
  }
  return "";
}

Eigen::Vector2d EdgesOff_px(const SensorRig& rig, const RigCheck& check) {
  // A point ahead that turns about y (down) goes right, about x (right) up.
  const Eigen::Vector3d& turn_rad = check.camera->turn_rad;
  return {rig.camera.fx * turn_rad.y(), -rig.camera.fy * turn_rad.x()};
}

ScanCheck JudgeScan(const SensorRig& rig, const Result<DepthCheck>& depth, const RigCheck& checked,
                    const std::vector<HalfFits>& objects) {
  return ScanJudge(rig, depth, checked, objects).Run();
}

Result<ScanCheck> CheckScan(const Scan& scan, const RegisteredScan& cloud, const CameraFrame* frame,
                            const std::vector<KeptObject>& kept, const ScanCheckOptions& options,
                            const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  Result<DepthCheck> depth = Fail(ErrorCode::kTooFewPoints, "the scan has no image");
  Result<RigCheck> rig = Fail(ErrorCode::kCancelled, "the check was cancelled");
  // They share nothing, and each has stretches that one core alone works on.
  const bool finished = ParallelFor(2, context, [&](int part) {
    if (part == 1)
      rig = CheckRig(scan, cloud, options.rig, context.Part(0.3, 0.6));
    else if (frame != nullptr)
      depth = CheckDepth(cloud, scan.rig, *frame, options.depth, options.depth_check,
                         context.Part(0.0, 0.6));
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "the check was cancelled");
  if (!depth && depth.error().code == ErrorCode::kCancelled) return tl::unexpected(depth.error());
  if (!rig) return tl::unexpected(rig.error());
  std::vector<HalfFits> objects;
  const auto count = static_cast<double>(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto at = static_cast<double>(i);
    FORESIGHT_TRY(
        const std::vector<HalfFits> halves,
        CheckHalves(cloud, scan.rig, kept[i], options.objects,
                    context.Part(0.6 + 0.4 * at / count, 0.6 + 0.4 * (at + 1.0) / count)));
    objects.insert(objects.end(), halves.begin(), halves.end());
  }
  ScanCheck check = JudgeScan(scan.rig, depth, *rig, objects);
  check.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return check;
}

}  // namespace foresight
