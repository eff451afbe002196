// foresightctl evaluate-boards: what the search for boards finds in a recorded session, against the
// truth.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/sensor/sensor_rig.h"
#include "tests/support/run_program.h"
#include "tests/support/small_camera.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

class EvaluateBoards : public testing::Test {
 protected:
  EvaluateBoards() {
    WriteScene("[0.9, 0, 1.4]");
    EXPECT_TRUE(SaveSensorRig(SmallCameraRig(), rig_));
    const ProgramResult recorded =
        RunProgram(FORESIGHTCTL, {"calibrate", "record", session_, "--scene", scene_, "--rig", rig_,
                                  "--stops", "0:10:10", "--lines", "0", "--sweep-speed", "0"});
    EXPECT_EQ(recorded.exit_code, 0) << recorded.errors;
  }
  void WriteScene(const std::string& position, const std::string& board_b = "7x6") {
    std::ofstream(scene_) << "foresight_scene: 1\nname: x\nambient: 0.7\n"
                             "materials: {paper: {color: [0.9, 0.9, 0.9], color2: [0, 0, 0]}}\n"
                             "stands: [{name: two, a: 'checkerboard:9x6:50', b: 'checkerboard:" +
                                 board_b +
                                 ":50', material: paper}]\n"
                                 "places: [{stand: two, name: ahead, position_m: " +
                                 position + "}]\n";
  }
  ProgramResult Evaluate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"evaluate-boards", session_, "--scene", scene_,
                                          "--rig",           rig_,     "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  }

  TemporaryFolder folder_;
  const std::string scene_ = folder_ / "scene.yaml";
  const std::string rig_ = folder_ / "rig.yaml";
  const std::string session_ = folder_ / "session";
};

TEST_F(EvaluateBoards, CountsBoardsThatAreWhereTheyWere) {
  const ProgramResult result = Evaluate();
  ASSERT_EQ(result.exit_code, 0) << result.errors << result.output;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["right"], 4);
  EXPECT_EQ(json["wrong"], 0);
  EXPECT_EQ(json["missed"], 0);
}

TEST_F(EvaluateBoards, CallsBoardsWrongThatAreElsewhere) {
  WriteScene("[0.9, 0.1, 1.4]");
  const ProgramResult result = Evaluate();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(result.output)["wrong"], 4);
}

// The cover of a board leaves it whole where it lies beside the corners.
TEST_F(EvaluateBoards, CoversHalfOfTheBoardsWhereToldTo) {
  int whole = 0;
  for (const char* seed : {"1", "2", "3", "4"}) {
    const ProgramResult result = Evaluate({"--cover", "--cover-seed", seed});
    ASSERT_EQ(result.exit_code, 0) << result.errors << result.output;
    const auto json = nlohmann::json::parse(result.output);
    EXPECT_EQ(json["wrong"], 0) << "seed " << seed;
    EXPECT_LE(json["right"], 4);
    whole += json["whole"].get<int>();
  }
  EXPECT_LT(whole, 16) << "of 16 boards some are covered";
  EXPECT_GT(whole, 0) << "and some are not";
  const auto boards = [&](const char* seed) {
    return nlohmann::json::parse(Evaluate({"--cover", "--cover-seed", seed}).output)["boards"];
  };
  EXPECT_EQ(boards("1"), boards("1")) << "the same seed, the same covers";
}

TEST_F(EvaluateBoards, DoesNotCountAWrongBoardAsNotFound) {
  WriteScene("[0.9, 0.1, 1.4]");
  EXPECT_EQ(nlohmann::json::parse(Evaluate().output)["missed"], 0);
}

TEST_F(EvaluateBoards, RefusesASceneOfOtherBoards) {
  WriteScene("[0.9, 0, 1.4]", "5x4");
  const ProgramResult result = Evaluate();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, HasSubstr("board B of the session is checkerboard:7x6:50"));
}

TEST_F(EvaluateBoards, RefusesASceneOfAnotherSession) {
  std::ofstream(scene_) << "foresight_scene: 1\nname: empty\n";
  const ProgramResult result = Evaluate();
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, HasSubstr("pose 'ahead' is no place of scene 'empty'"));
}

}  // namespace
}  // namespace foresight
