// A door handle and a cylinder go the way of every object: fitted, kept, told to a robot, made
// again, exported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/detection/detection_json.h"
#include "core/mission/mission_file.h"
#include "core/mission/pose_json.h"
#include "core/simulation/scene.h"
#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;

std::string DoorScene() {
  return FORESIGHT_SOURCE_DIR "/resources/scenes/door.yaml";
}

constexpr const char* kPole =
    "foresight_scene: 1\n"
    "name: pole\n"
    "lights:\n"
    "  - {position_m: [0.3, 1.4, 2.6]}\n"
    "materials: {grey: {lidar_reflectance: 0.5}}\n"
    "solids:\n"
    "  - {shape: plane, size_m: [8, 8], position_m: [3, 0, 1], rpy_deg: [0, -90, 0], material: "
    "grey}\n"
    "  - {shape: cylinder, radius_m: 0.06, from_m: [1.6, 0.1, 0], to_m: [1.6, 0.1, 2.8], material: "
    "grey}\n";

/// A mission with one scan of a scene and what was fitted in a box, in the robot's frame.
class KeptObject {
 public:
  KeptObject(const std::string& scene, const char* kind, const char* box)
      : mission_(folder_ / "mission.foresight") {
    const ProgramResult scanned =
        Ctl({"scan", "--scene", scene, "--rig", HalfCameraFile(folder_), "--from", "-35", "--to",
             "15", "--speed", "20", "--out", mission_});
    EXPECT_EQ(scanned.exit_code, 0) << scanned.errors;
    fit_ = Ctl({"fit", kind, mission_, "--box", box, "--save", "--json"});
    EXPECT_LE(fit_.exit_code, 1) << fit_.errors;
  }

  nlohmann::json Answer() const { return nlohmann::json::parse(fit_.output); }
  const std::string& Mission() const { return mission_; }
  std::string Path(const char* name) const { return folder_ / name; }
  DetectionRecord Record() const {
    const auto records = MissionFile::OpenReadOnly(mission_).value()->ListDetections().value();
    EXPECT_EQ(records.size(), 1u);
    return records.front();
  }

 private:
  TemporaryFolder folder_;
  std::string mission_;
  ProgramResult fit_;
};

constexpr const char* kHandleBox = "1.16,0.40,1.06,0.16,0.22,0.16";

TEST(FitHandleInAScan, FindsTheLeverOfTheDoorThatIsShipped) {
  const KeptObject kept(DoorScene(), "handle", kHandleBox);
  const auto answer = kept.Answer();
  const HandleTruth truth = LoadScene(DoorScene())->handles.front();
  const auto& best = answer["best"];
  const auto& at = best["robot_from_object"];
  Eigen::Vector3d position, x;
  for (int i = 0; i < 3; ++i) {
    position[i] = at["position_m"][i].get<double>();
    x[i] = at["x_axis"][i].get<double>();
  }
  // What counts as right in docs/evaluation.md.
  EXPECT_LT((position - truth.robot_from_object.translation()).norm(), 0.015);
  EXPECT_GT(x.dot(truth.robot_from_object.Rotate(Eigen::Vector3d::UnitX())), std::cos(0.14));
  EXPECT_NEAR(best["model"]["length_m"].get<double>(), truth.model.length_m, 0.020);
  EXPECT_NE(answer["verdict"], "UNSURE") << answer["reason"];
  EXPECT_GE(answer["alternatives"].size(), 3u) << "flipped, shorter and longer";
  EXPECT_GT(answer["alternatives"][0]["margin_nats"].get<double>(), 0.0);
}

TEST(FitHandleInAScan, IsKeptMadeAgainToldToARobotExportedAndReported) {
  const KeptObject kept(DoorScene(), "handle", kHandleBox);
  EXPECT_EQ(kept.Record().kind, "handle");
  const ProgramResult again = Ctl({"mission", "check", kept.Mission(), "--recompute"});
  EXPECT_EQ(again.exit_code, 0) << again.output << again.errors;
  const ProgramResult pose = Ctl({"mission", "pose", kept.Mission(), "--detection", "1", "--json"});
  ASSERT_EQ(pose.exit_code, 0) << pose.errors;
  const auto message = PoseMessageFromJson(pose.output);
  ASSERT_TRUE(message) << message.error().message;
  EXPECT_NEAR(std::get<HandleParameters>(message->parameters).model.length_m, 0.125, 0.02);
  EXPECT_TRUE(message->covariance);
  ASSERT_EQ(Ctl({"mission", "export", kept.Mission(), "-o", kept.Path("export")}).exit_code, 0);
  const std::string table = ReadFile(kept.Path("export") + "/detections.csv").value();
  EXPECT_THAT(table, HasSubstr("handle"));
  ASSERT_EQ(Ctl({"mission", "report", kept.Mission(), "-o", kept.Path("report")}).exit_code, 0);
}

TEST(FitHandleInAScan, APullBarIsNotEvenLikelyToBeOne) {
  const KeptObject kept(DoorScene(), "handle", "1.16,-0.22,1.05,0.16,0.34,0.16");
  EXPECT_EQ(kept.Answer()["verdict"], "UNSURE");
  EXPECT_THAT(kept.Answer()["reason"].get<std::string>(), HasSubstr("pull bar"));
}

TEST(MissionDecide, TakesBackNamesAndDeletesWhatTheShellDecided) {
  const TemporaryFolder folder;
  const std::string scene = folder / "pole.yaml";
  ASSERT_TRUE(WriteFileAtomically(scene, kPole));
  const KeptObject kept(scene, "cylinder", "1.6,0.1,1.2,0.4,0.5,0.5");
  const auto decide = [&](std::vector<std::string> what) {
    what.insert(what.begin(), {"mission", "decide", kept.Mission(), "1"});
    return Ctl(what);
  };
  const ProgramResult accepted = decide({"--accept", "--json", "--remark", "seen in the image"});
  ASSERT_EQ(accepted.exit_code, 0) << accepted.errors;
  EXPECT_EQ(nlohmann::json::parse(accepted.output)["decision"], "accepted");
  EXPECT_EQ(kept.Record().decision, Decision::kAccepted);
  // What is accepted is fitted again by the check of the scan.
  const ProgramResult check = Ctl({"check", kept.Mission()});
  EXPECT_THAT(check.output, HasSubstr("even and odd lines agree")) << check.errors;
  EXPECT_EQ(decide({"--name", "riser"}).exit_code, 0);
  EXPECT_EQ(decide({"--reject"}).exit_code, 0);
  EXPECT_EQ(kept.Record().decision, Decision::kRejected);
  EXPECT_EQ(decide({"--delete"}).exit_code, 0);
  EXPECT_TRUE(kept.Record().deleted);
  EXPECT_EQ(decide({"--restore"}).exit_code, 0);
  EXPECT_EQ(decide({"--reopen"}).exit_code, 0);
  EXPECT_EQ(kept.Record().decision, Decision::kOpen);
  EXPECT_EQ(kept.Record().name, "riser");
  EXPECT_FALSE(kept.Record().deleted);
}

TEST(MissionDecide, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string scene = folder / "pole.yaml";
  ASSERT_TRUE(WriteFileAtomically(scene, kPole));
  const KeptObject kept(scene, "cylinder", "1.6,0.1,1.2,0.4,0.5,0.5");
  const ProgramResult nothing = Ctl({"mission", "decide", kept.Mission(), "1"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("give one of --accept, --reject"));
  const ProgramResult other = Ctl({"mission", "decide", kept.Mission(), "7", "--accept"});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.errors, HasSubstr("there is no object 7; foresightctl mission show"));
  const ProgramResult note = Ctl({"mission", "note", kept.Mission(), "bent", "--object", "7"});
  EXPECT_EQ(note.exit_code, 3);
  EXPECT_EQ(note.errors, other.errors) << "an object is looked for in one way";
  const ProgramResult answer =
      Ctl({"mission", "decide", kept.Mission(), "1", "--accept", "--answer", "2"});
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_THAT(answer.errors, HasSubstr("object 1 has no answer 2; it has 1 to 1"));
  const ProgramResult both =
      Ctl({"mission", "decide", kept.Mission(), "1", "--accept", "--reject"});
  EXPECT_EQ(both.exit_code, 2);
}

TEST(FitCylinderInAScan, IsKeptMadeAgainAndToldToARobotWithoutAProbability) {
  const TemporaryFolder folder;
  const std::string scene = folder / "pole.yaml";
  ASSERT_TRUE(WriteFileAtomically(scene, kPole));
  const KeptObject kept(scene, "cylinder", "1.6,0.1,1.2,0.4,0.5,0.5");
  EXPECT_EQ(kept.Record().kind, "cylinder");
  const auto answer = kept.Answer();
  EXPECT_NEAR(answer["radius_m"].get<double>(), 0.060, 0.008);
  EXPECT_TRUE(answer["probability"].is_null());
  EXPECT_EQ(answer["verdict"], "LIKELY") << answer["reason"];
  EXPECT_THAT(answer["gates"].dump(), HasSubstr("never confirmed"));
  const ProgramResult again = Ctl({"mission", "check", kept.Mission(), "--recompute"});
  EXPECT_EQ(again.exit_code, 0) << again.output << again.errors;
  const ProgramResult pose = Ctl({"mission", "pose", kept.Mission(), "--detection", "1", "--json"});
  ASSERT_EQ(pose.exit_code, 0) << pose.errors;
  const auto message = PoseMessageFromJson(pose.output);
  ASSERT_TRUE(message) << message.error().message;
  EXPECT_FALSE(message->probability);
  EXPECT_TRUE(std::holds_alternative<CylinderParameters>(message->parameters));
}

}  // namespace
}  // namespace foresight
