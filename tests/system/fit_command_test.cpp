// `foresightctl fit` on scans, depth maps and point clouds; whatever it is fed, one clear line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/detection/detection_json.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/mission/mission_file.h"
#include "core/mission/pose_json.h"
#include "core/sensor/sensor_rig.h"
#include "tests/support/run_program.h"
#include "tests/support/small_camera.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

Eigen::Vector3d PositionOf(const nlohmann::json& object) {
  const auto& p = object["robot_from_object"]["position_m"];
  return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
}

Eigen::Vector3d PositionIn(const nlohmann::json& answer) {
  return PositionOf(answer["best"]);
}

TEST(FitHelp, BeginsWithWhatEveryFitNeedsAndEndsWithTheDepthMethods) {
  const std::string help = RunProgram(FORESIGHTCTL, {"fit", "valve", "--help"}).output;
  std::size_t last = 0;
  for (const char* text :
       {"--mission ", "--image ", "--source ", "Region, one of", "--roi ", "--box ",
        "\nAnswer:", "--json ", "--save ", "\nInstead of a mission:", "--cloud ",
        "\nIn a scan that a head keeps:", "--head ", "\nWhat a valve may be", "--max-rays ",
        "\nDepth map:", "--method ", "--threshold "}) {
    const std::size_t at = help.find(text, last);
    ASSERT_NE(at, std::string::npos) << text << " is not behind the one before in\n" << help;
    last = at;
  }
  const std::size_t heading = help.find("\nDepth map:");
  EXPECT_EQ(help.find("\n\n\n", heading), std::string::npos) << "no heading follows";
  EXPECT_LT(std::count(help.begin(), help.begin() + static_cast<std::ptrdiff_t>(help.find("--box")),
                       '\n'),
            30)
      << "the region stands on the first page";
}

/// One scan of the valve scene for all tests.
class FitOfAScan : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    mission_ = *folder_ / "mission.foresight";
    const ProgramResult scanned =
        Run({"scan", "--scene", kValveScene, "--rig", HalfCameraFile(*folder_), "--from", "-15",
             "--to", "15", "--out", mission_});
    ASSERT_EQ(scanned.exit_code, 0) << scanned.errors;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ProgramResult Run(const std::vector<std::string>& arguments) {
    return RunProgram(FORESIGHTCTL, arguments);
  }
  static ProgramResult Fit(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"fit", "valve", mission_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Run(arguments);
  }
  /// The scene rendered: depth.pfm, rig.yaml.
  static std::string Rendered() {
    const std::string out = *folder_ / "rendered";
    if (!std::filesystem::exists(out)) {
      EXPECT_EQ(
          Run({"render", kValveScene, "--rig", HalfCameraFile(*folder_), "--out", out}).exit_code,
          0);
    }
    return out;
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::string mission_;
};

TEST_F(FitOfAScan, EveryWayToDrawTheRegionFindsTheSameValve) {
  const ProgramResult rectangle = Fit({"--roi", kValveRegion, "--json"});
  ASSERT_EQ(rectangle.exit_code, 0) << rectangle.errors << rectangle.output;
  const auto reference = nlohmann::json::parse(rectangle.output);
  EXPECT_EQ(reference["source"], "raw");
  const Eigen::Vector3d at = PositionIn(reference);
  const std::string box = fmt::format("{},{},{},0.5,0.5,0.5", at.x(), at.y(), at.z());
  for (const auto& region :
       std::vector<std::vector<std::string>>{{"--polygon", "267,206,360,206,360,301,267,301"},
                                             {"--two-clicks", "278,254,349,254"},
                                             {"--box", box}}) {
    const ProgramResult result = Fit({region[0], region[1], "--json"});
    ASSERT_EQ(result.exit_code, 0) << region[0] << result.errors << result.output;
    // Other rays at the region's rim, another random search: the same valve to a few millimetres.
    EXPECT_LT((PositionIn(nlohmann::json::parse(result.output)) - at).norm(), 0.010) << region[0];
  }
}

TEST_F(FitOfAScan, TheSourceIsNotedAndDepthIsAnOldNameOfTheDefaultMethod) {
  const ProgramResult paper = Fit({"--roi", kValveRegion, "--source", "paper", "--json"});
  ASSERT_LE(paper.exit_code, 1) << paper.errors;
  EXPECT_EQ(nlohmann::json::parse(paper.output)["source"], "paper");
  const ProgramResult depth = Fit({"--roi", kValveRegion, "--source", "depth", "--json"});
  ASSERT_LE(depth.exit_code, 1) << depth.errors;
  EXPECT_EQ(nlohmann::json::parse(depth.output)["source"], "foresight");
  EXPECT_EQ(Fit({"--roi", kValveRegion, "--source", "guess"}).exit_code, 2);
}

TEST_F(FitOfAScan, TheImageShowsTheAnswer) {
  const std::string file = *folder_ / "answer.png";
  ASSERT_EQ(Fit({"--roi", kValveRegion, "--picture", file}).exit_code, 0);
  const auto image = ReadPng(file);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width(), 644);
  // Green or orange lines: saturated, which nothing in this grey scene of bricks is at this level.
  int strong = 0;
  for (const Rgb8& p : image->values())
    strong += std::max({p.r, p.g, p.b}) - std::min({p.r, p.g, p.b}) > 150 ? 1 : 0;
  EXPECT_GT(strong, 100);
}

TEST_F(FitOfAScan, TheGallerySetsAllSixSourcesSideBySide) {
  const std::filesystem::path out = *folder_ / "gallery";
  // A quarter of the image's size: the slowest methods take 20 s at the whole.
  const std::string rig = *folder_ / "small_rig.yaml";
  const std::string mission = *folder_ / "small.foresight";
  ASSERT_TRUE(SaveSensorRig(SmallCameraRig(), rig));
  const ProgramResult scanned = Run({"scan", "--scene", kValveScene, "--rig", rig, "--from", "-15",
                                     "--to", "15", "--out", mission});
  ASSERT_EQ(scanned.exit_code, 0) << scanned.errors;
  const ProgramResult result =
      Run({"fit", "valve", mission, "--roi", "133,103,180,150", "--gallery", out.string()});
  ASSERT_LE(result.exit_code, 1) << result.errors;
  const std::string page = ReadFile(out / "index.html").value();
  for (const std::string source :
       {"raw", "foresight-alone", "paper-alone", "jbu-alone", "tgv-alone", "nonlocal-alone"}) {
    EXPECT_TRUE(std::filesystem::exists(out / (source + ".png"))) << source;
    EXPECT_NE(page.find(source + ".png"), std::string::npos) << source;
  }
}

TEST_F(FitOfAScan, AnAnswerThatIsSavedStaysInTheMission) {
  const std::string copy = *folder_ / "copy.foresight";
  std::filesystem::copy_file(mission_, copy);
  EXPECT_EQ(Run({"fit", "valve", copy, "--roi", kValveRegion, "--save"}).exit_code, 0);
  const auto detections = MissionFile::OpenReadOnly(copy).value()->ListDetections();
  ASSERT_TRUE(detections) << detections.error().message;
  ASSERT_EQ(detections->size(), 1U);
  EXPECT_EQ(detections->front().kind, "valve");
  EXPECT_TRUE(DetectionFromJson(detections->front().json));
}

TEST_F(FitOfAScan, AnObjectThatIsSavedIsShownAsARobotWouldGetIt) {
  const std::string copy = *folder_ / "pose.foresight";
  std::filesystem::copy_file(mission_, copy);
  ASSERT_EQ(Run({"fit", "valve", copy, "--roi", kValveRegion, "--save"}).exit_code, 0);
  const ProgramResult shown = Run({"mission", "pose", copy, "--detection", "1", "--json"});
  ASSERT_EQ(shown.exit_code, 0) << shown.errors;
  EXPECT_EQ(std::count(shown.output.begin(), shown.output.end(), '\n'), 1) << shown.output;
  const auto pose = PoseMessageFromJson(shown.output);
  ASSERT_TRUE(pose) << pose.error().message;
  const auto record = MissionFile::OpenReadOnly(copy).value()->ListDetections()->front();
  const auto valve = std::get<ValveDetection>(DetectionFromJson(record.json).value());
  EXPECT_EQ(pose->Id(), record.uuid + "/1");
  EXPECT_EQ(pose->frame, PoseMessage::Frame::kBase) << "nobody measured how this head is mounted";
  EXPECT_EQ(pose->position_m, valve.best.base_from_object.translation());
  EXPECT_EQ(pose->origin, PoseMessage::Origin::kReview);
  EXPECT_TRUE(pose->simulated);
  EXPECT_EQ(pose->decision, Decision::kOpen);

  const ProgramResult table = Run({"mission", "pose", copy});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_NE(table.output.find(record.uuid), std::string::npos) << table.output;
  const ProgramResult none = Run({"mission", "pose", copy, "--detection", "7", "--json"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.errors.find("no detection 7"), std::string::npos) << none.errors;
  EXPECT_EQ(Run({"mission", "pose", copy, "--detection", "1", "--candidate", "99"}).exit_code, 3);
  EXPECT_EQ(Run({"mission", "pose", copy, "--candidate", "1"}).exit_code, 2) << "of which one?";
}

TEST_F(FitOfAScan, ATerrainWithoutASurfaceHasNoPoseAndTheOthersAreShown) {
  const std::string copy = *folder_ / "poses.foresight";
  std::filesystem::copy_file(mission_, copy);
  ASSERT_EQ(Run({"fit", "valve", copy, "--roi", kValveRegion, "--save"}).exit_code, 0);
  {
    const auto mission = MissionFile::Open(copy).value();
    DetectionRecord terrain = mission->ListDetections()->front();
    terrain.uuid = "bare";
    terrain.kind = "terrain";
    terrain.json = DetectionToJson(TerrainDetection(), {});
    ASSERT_TRUE(mission->AddDetection(terrain));
  }
  const ProgramResult all = Run({"mission", "pose", copy, "--json"});
  EXPECT_EQ(all.exit_code, 0) << all.errors;
  EXPECT_TRUE(PoseMessageFromJson(all.output)) << all.output;
  EXPECT_NE(all.errors.find("object bare: no answer 0"), std::string::npos) << all.errors;
  EXPECT_EQ(Run({"mission", "pose", copy, "--detection", "2"}).exit_code, 3);
}

TEST_F(FitOfAScan, WhatIsSavedIsMadeAgainWithoutADifferenceAndAChangeOfItIsNamed) {
  const std::string copy = *folder_ / "again.foresight";
  std::filesystem::copy_file(mission_, copy);
  const auto recheck = [&] { return Run({"mission", "check", "--recompute", "--json", copy}); };
  EXPECT_LE(Run({"fit", "valve", copy, "--roi", kValveRegion, "--source", "paper",
                 "--sigma-spatial", "9.3", "--threshold", "0.4", "--seed", "18446744073709551615",
                 "--max-spokes", "5", "--save"})
                .exit_code,
            1)
      << "an UNSURE answer is kept too";
  EXPECT_EQ(
      Run({"depth", copy, "--save", "--flying", "adaptive", "--out", *folder_ / "d"}).exit_code, 0);
  const ProgramResult same = recheck();
  EXPECT_EQ(same.exit_code, 0) << same.output << same.errors;
  const auto records = nlohmann::json::parse(same.output).at("recomputed");
  ASSERT_EQ(records.size(), 2u);
  for (const auto& record : records) EXPECT_EQ(record.at("outcome"), "same") << record;

  {
    const auto mission = MissionFile::Open(copy).value();
    DetectionRecord other = mission->ListDetections()->front();
    other.uuid = "other";
    const std::size_t at = other.provenance_json.find("\"max_spokes\":5");
    ASSERT_NE(at, std::string::npos);
    other.provenance_json.replace(at, 14, "\"max_spokes\":2");
    ASSERT_TRUE(mission->AddDetection(other));
  }
  const ProgramResult different = recheck();
  EXPECT_EQ(different.exit_code, 1) << different.errors;
  EXPECT_EQ(nlohmann::json::parse(different.output).at("different"), 1);
}

TEST_F(FitOfAScan, TheMissionListsItsScans) {
  const ProgramResult list = Run({"mission", "list", "--json", mission_});
  ASSERT_EQ(list.exit_code, 0) << list.errors;
  const auto scans = nlohmann::json::parse(list.output).at("scans");
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].at("state"), "complete");
  EXPECT_NEAR(scans[0].at("to_deg").get<double>(), 15.0, 1e-9);
  EXPECT_EQ(Run({"mission", "list", *folder_ / "none.foresight"}).exit_code, 3);
  EXPECT_EQ(Run({"mission", "check", mission_}).exit_code, 0);
}

TEST_F(FitOfAScan, ADepthMapIsFittedWithItsCamera) {
  const std::string out = Rendered();
  const std::vector<std::string> fit = {"fit",    "valve",           "--depth", out + "/depth.pfm",
                                        "--rig",  out + "/rig.yaml", "--roi",   kValveRegion,
                                        "--json", "--density",       "0.2"};
  const ProgramResult result = Run(fit);
  ASSERT_LE(result.exit_code, 1) << result.errors;
  const auto answer = nlohmann::json::parse(result.output);
  ASSERT_TRUE(answer.contains("best")) << result.output;
  const auto scanned = nlohmann::json::parse(Fit({"--roi", kValveRegion, "--json"}).output);
  // The true depth of the same scene against a noisy scan of it.
  EXPECT_LT((PositionIn(answer) - PositionIn(scanned)).norm(), 0.020);
}

TEST_F(FitOfAScan, APointCloudWithoutAValveIsANegativeAnswer) {
  const std::string file = *folder_ / "wall.ply";
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 900\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  for (int i = 0; i < 900; ++i) ply += fmt::format("2 {} {}\n", 0.02 * (i % 30), 0.02 * (i / 30));
  ASSERT_TRUE(WriteFileAtomically(file, ply));
  const ProgramResult result =
      Run({"fit", "valve", "--cloud", file, "--viewpoint", "0,0.3,0.3", "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.errors << result.output;
  EXPECT_EQ(nlohmann::json::parse(result.output)["verdict"], "UNSURE");
}

TEST_F(FitOfAScan, APoleInACloudOfFourFloatsAPointIsACylinder) {
  // The half of a pole of 80 mm that faces the viewpoint, before a wall, as beams intersect them.
  constexpr double kRadius_m = 0.080, kDistance_m = 2.0, kWall_m = 3.0;
  std::string bytes;
  for (double up = -0.2; up < 0.2; up += 0.01)
    for (double left = -0.1; left < 0.1; left += 0.004) {
      const double aside_m = kDistance_m * std::sin(left);
      const double range_m =
          std::abs(aside_m) < kRadius_m
              ? kDistance_m * std::cos(left) - std::sqrt(kRadius_m * kRadius_m - aside_m * aside_m)
              : kWall_m / std::cos(left);
      const float point[4] = {static_cast<float>(range_m * std::cos(left)),
                              static_cast<float>(range_m * std::sin(left)),
                              static_cast<float>(range_m * std::tan(up)), 0.5f};
      bytes.append(reinterpret_cast<const char*>(point), sizeof(point));
    }
  const std::string file = *folder_ / "pole.bin";
  ASSERT_TRUE(WriteFileAtomically(file, bytes));
  const std::string image = *folder_ / "pole.png";
  const ProgramResult result = Run({"fit", "cylinder", "--cloud", file, "--viewpoint", "0,0,0",
                                    "--box", "2,0,0,0.6,0.6,0.6", "--json", "--picture", image});
  ASSERT_EQ(result.exit_code, 0) << result.errors << result.output;
  const auto answer = nlohmann::json::parse(result.output);
  EXPECT_EQ(answer["kind"], "cylinder");
  EXPECT_EQ(answer["verdict"], "LIKELY");
  EXPECT_TRUE(answer["probability"].is_null());
  EXPECT_NEAR(answer["radius_m"].get<double>(), kRadius_m, 0.008);
  EXPECT_GT(answer["robot_from_object"]["z_axis"][2].get<double>(), 0.99);
  EXPECT_GT(answer["evidence"]["inlier_ratio"].get<double>(), 0.9);
  EXPECT_TRUE(ReadPng(image));
  const ProgramResult beside = Run({"fit", "cylinder", "--cloud", file, "--viewpoint", "0,0,0",
                                    "--box", "2,3,0,0.3,0.3,0.3", "--json"});
  EXPECT_EQ(beside.exit_code, 1) << beside.output;
  EXPECT_EQ(nlohmann::json::parse(beside.output)["verdict"], "UNSURE");
}

// The front of a thin pipe is flat to within the noise, and the wall behind it a large cylinder's.
TEST_F(FitOfAScan, PipesAreFoundBeforeTheirWall) {
  struct Pipe {
    const char* name;
    std::vector<std::string> box;
    double radius_m;
    Eigen::Vector3d on_axis, axis;
  };
  const Pipe pipes[] = {
      {"riser", {"1.61", "0.42", "1.3", "0.3", "0.3", "0.8"}, 0.030, {1.61, 0.42, 0.0}, {0, 0, 1}},
      {"drain",
       {"1.61", "-0.55", "1.1", "0.25", "0.25", "0.4"},
       0.020,
       {1.62, -0.55, 0},
       {0, 0, 1}},
      {"main pipe",
       {"1.61", "0.7", "1.36", "0.3", "0.5", "0.3"},
       0.050,
       {1.62, 0, 1.36},
       {0, 1, 0}},
  };
  for (const Pipe& pipe : pipes) {
    std::vector<std::string> arguments = {"fit", "cylinder", mission_, "--json", "--box"};
    arguments.insert(arguments.end(), pipe.box.begin(), pipe.box.end());
    const ProgramResult fitted = Run(arguments);
    ASSERT_LE(fitted.exit_code, 1) << pipe.name << ": " << fitted.errors;
    const auto answer = nlohmann::json::parse(fitted.output);
    EXPECT_NEAR(answer["radius_m"].get<double>(), pipe.radius_m, 0.004) << pipe.name;
    EXPECT_LT((PositionOf(answer) - pipe.on_axis).cross(pipe.axis).norm(), 0.006) << pipe.name;
  }
}

TEST_F(FitOfAScan, InALargeBoxTheWheelIsNotLostToAConduitAtItsEdge) {
  const ProgramResult answer = Fit({"--box", "1.55,0.05,1.15,0.3,0.8,0.9", "--json"});
  const auto json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json["best"]["model"]["kind"], "wheel");
  EXPECT_EQ(json["best"]["model"]["spokes"], 3);
  EXPECT_LT((PositionIn(json) - Eigen::Vector3d(1.463, 0.031, 1.380)).norm(), 0.010);
}

TEST_F(FitOfAScan, ARegionMuchLargerThanTheWheelIsLookedAtAgainCloser) {
  // With 77 beams of it on the wheel three of these seeds were UNSURE.
  for (const char* seed : {"2", "4", "5"}) {
    const ProgramResult result = Fit({"--roi", "231,185,402,327", "--seed", seed, "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.output << result.errors;
    EXPECT_EQ(nlohmann::json::parse(result.output)["best"]["model"]["spokes"], 3) << seed;
  }
}

TEST_F(FitOfAScan, ThreePointsAreTooFew) {
  const std::string file = *folder_ / "three.ply";
  ASSERT_TRUE(WriteFileAtomically(
      file,
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1 0 0\n1 0.1 0\n1 0 0.1\n"));
  const ProgramResult result =
      Run({"fit", "valve", "--cloud", file, "--viewpoint", "0,0,0", "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["verdict"], "UNSURE");
}

/// One line on standard error that holds `what`, and this exit code.
void ExpectRefused(const ProgramResult& result, int exit_code, const std::string& what) {
  EXPECT_EQ(result.exit_code, exit_code) << result.errors;
  EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
  EXPECT_NE(result.errors.find(what), std::string::npos) << result.errors;
}

TEST_F(FitOfAScan, ARegionThatIsNoneIsWrongUsage) {
  ExpectRefused(Fit({}), 2, "region");
  ExpectRefused(Fit({"--roi", kValveRegion, "--two-clicks", "1,1,9,9"}), 2, "one region");
  ExpectRefused(Fit({"--roi", "500,500,501,501"}), 2, "too small");
  ExpectRefused(Fit({"--roi", "5000,5000,6000,6000"}), 2, "outside the image");
  ExpectRefused(Fit({"--box", "1,0,1,-1,1,1"}), 2, "box");
  ExpectRefused(Fit({"--polygon", "1,1,9,9,1,9,4"}), 2, "x,y pairs");
  ExpectRefused(Run({"fit", "valve", "--roi", kValveRegion}), 2, "mission");
}

TEST_F(FitOfAScan, TheLastAnswerOfAnotherObjectOrOfNoneIsBadData) {
  const std::string valve = *folder_ / "valve.json";
  const ProgramResult answer = Fit({"--roi", kValveRegion, "--json"});
  ASSERT_TRUE(WriteFileAtomically(valve, answer.output));
  const auto terrain = [](const std::string& last) {
    return Run({"fit", "terrain", mission_, "--roi", kValveRegion, "--last", last});
  };
  EXPECT_EQ(terrain(valve).exit_code, 3);
  EXPECT_NE(terrain(valve).errors.find("holds a valve, not a terrain"), std::string::npos);
  EXPECT_EQ(terrain(valve + ".missing").exit_code, 3);
}

TEST_F(FitOfAScan, ABoxWithNothingInItIsANegativeAnswer) {
  const ProgramResult result = Fit({"--box", "-5,0,1,0.3,0.3,0.3", "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["verdict"], "UNSURE");
}

TEST_F(FitOfAScan, ADepthMapWithoutANumberIsANegativeAnswer) {
  const std::string out = Rendered(), file = *folder_ / "nan.pfm";
  const SensorRig rig = LoadSensorRig(out + "/rig.yaml").value();
  ASSERT_TRUE(WritePfm(file, FloatImage(rig.camera.width, rig.camera.height,
                                        std::numeric_limits<float>::quiet_NaN())));
  const ProgramResult result = Run({"fit", "valve", "--depth", file, "--rig", out + "/rig.yaml",
                                    "--roi", kValveRegion, "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["verdict"], "UNSURE");
}

TEST_F(FitOfAScan, DamagedFilesAndACameraThatMirrorsAreBadData) {
  const std::string out = Rendered(), cloud = *folder_ / "nan.ply";
  ASSERT_TRUE(WriteFileAtomically(
      cloud,
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\nnan nan nan\n"));
  ExpectRefused(Run({"fit", "valve", "--cloud", cloud, "--viewpoint", "0,0,0"}), 3, "nan.ply");
  ASSERT_TRUE(WritePfm(*folder_ / "small.pfm", FloatImage(64, 48, 1000.0f)));
  ExpectRefused(Run({"fit", "valve", "--depth", *folder_ / "small.pfm", "--rig", out + "/rig.yaml",
                     "--roi", "1,1,40,40"}),
                3, "64 x 48");
  const std::string rig = ReadFile(out + "/rig.yaml").value();
  const auto at = rig.find("fx: ");
  ASSERT_NE(at, std::string::npos);
  const std::string mirrored = rig.substr(0, at + 4).append("-").append(rig.substr(at + 4));
  ASSERT_TRUE(WriteFileAtomically(*folder_ / "mirrored.yaml", mirrored));
  ExpectRefused(Run({"fit", "valve", "--depth", out + "/depth.pfm", "--rig",
                     *folder_ / "mirrored.yaml", "--roi", kValveRegion}),
                3, "mirrored.yaml");
}

}  // namespace
}  // namespace foresight
