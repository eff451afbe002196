// foresightctl calibrate record: a session from a head, place after place.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/calibration/session_index.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

class CalibrateRecord : public testing::Test {
 protected:
  CalibrateRecord() {
    std::ofstream(scene_)
        << "foresight_scene: 1\nname: x\nambient: 0.7\n"
           "materials: {paper: {color: [0.9, 0.9, 0.9], color2: [0, 0, 0]}}\n"
           "stands: [{name: one, a: 'checkerboard:7x6:50', material: paper},\n"
           "         {name: two, a: 'checkerboard:9x6:50', b: 'checkerboard:7x6:50', material: "
           "paper}]\n"
           "places: [{stand: one, name: near, position_m: [0.7, 0, 1.4]},\n"
           "         {stand: two, name: left, position_m: [1.2, 0.2, 1.4]}]\n";
  }
  ProgramResult Record(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"calibrate", "record",  session_,  "--scene", scene_,
                                          "--stops",   "0:10:10", "--lines", "3",       "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  }

  TemporaryFolder folder_;
  const std::string scene_ = folder_ / "scene.yaml";
  const std::string session_ = folder_ / "session";
};

TEST_F(CalibrateRecord, GoesThroughThePlacesAndOnWithASessionThatIsThere) {
  const ProgramResult all = Record({});
  ASSERT_EQ(all.exit_code, 0) << all.errors;
  const auto json = nlohmann::json::parse(all.output);
  EXPECT_EQ(json["intrinsic_views"], 1);
  EXPECT_EQ(json["poses"], 1);
  EXPECT_EQ(json["stops"], 2);
  EXPECT_EQ(json["images"], 2);
  EXPECT_EQ(json["sweeps"], 1);
  EXPECT_THAT(all.errors, testing::HasSubstr("left: stop 2 of 2 at 10.0 deg"));
  ASSERT_EQ(Record({"--places", "2", "--sweep-speed", "0"}).exit_code, 0);
  const auto index = ReadSessionIndex(session_);
  ASSERT_TRUE(index) << index.error().message;
  EXPECT_EQ(index->mount.b->columns, 7);
  EXPECT_EQ(index->intrinsic_board->columns, 7);
  ASSERT_EQ(index->poses.size(), 2u);
  EXPECT_EQ(index->poses[0].name, "left");
  EXPECT_EQ(index->poses[0].sweeps.size(), 1u);
  EXPECT_TRUE(index->poses[1].sweeps.empty());
  EXPECT_EQ(index->poses[1].stops.size(), 2u);
}

TEST_F(CalibrateRecord, RefusesStopsAndPlacesThatAreNone) {
  const ProgramResult stops = RunProgram(
      FORESIGHTCTL, {"calibrate", "record", session_, "--scene", scene_, "--stops", "0:0:10"});
  EXPECT_NE(stops.exit_code, 0);
  EXPECT_THAT(stops.errors, testing::HasSubstr("FROM:STEP:TO"));
  const ProgramResult place = Record({"--places", "5"});
  EXPECT_EQ(place.exit_code, 3);
  EXPECT_THAT(place.errors, testing::HasSubstr("no place 5; it has 2"));
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"calibrate", "record", session_}).exit_code, 2);
}

}  // namespace
}  // namespace foresight
