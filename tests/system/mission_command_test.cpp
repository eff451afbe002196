// `foresightctl mission`: what a reviewer does with mission files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/base/atomic_file.h"
#include "core/mission/mission_file.h"
#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// Two missions, a scan each; a valve was found in the first.
class MissionCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    first_ = *folder_ / "first.foresight";
    second_ = *folder_ / "second.foresight";
    for (const auto& [file, to] : {std::pair(first_, "12"), std::pair(second_, "8")}) {
      const ProgramResult scanned =
          Run({"scan", "--scene", kValveScene, "--rig", HalfCameraFile(*folder_), "--from", "-10",
               "--to", to, "--out", file});
      ASSERT_EQ(scanned.exit_code, 0) << scanned.errors;
    }
    ASSERT_EQ(Run({"fit", "valve", first_, "--roi", kValveRegion, "--save"}).exit_code, 0);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ProgramResult Run(const std::vector<std::string>& arguments) {
    return RunProgram(FORESIGHTCTL, arguments);
  }
  static ProgramResult Mission(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "mission");
    return Run(arguments);
  }
  static nlohmann::json Json(const ProgramResult& result) {
    return nlohmann::json::parse(result.output);
  }
  static std::string In(const std::string& name) { return *folder_ / name; }

  static std::map<std::string, std::string> FilesOf(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), folder)] = ReadFile(entry.path()).value();
    return files;
  }

  /// What a mission has otherwise than the first one.
  static std::vector<std::string> DifferencesFrom(const std::string& name) {
    const ProgramResult diff = Mission({"diff", first_, In(name), "--json"});
    EXPECT_EQ(diff.exit_code, 1);
    std::vector<std::string> texts;
    const nlohmann::json json = Json(diff);
    for (const auto& difference : json.at("differences"))
      texts.push_back(difference["what"].get<std::string>() + " " +
                      difference["kind"].get<std::string>());
    return texts;
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::string first_;
  static inline std::string second_;
};

TEST_F(MissionCommand, ShowTellsWhatAMissionAndAScanHold) {
  const ProgramResult mission = Mission({"show", first_, "--json"});
  ASSERT_EQ(mission.exit_code, 0) << mission.errors;
  const auto all = Json(mission);
  EXPECT_EQ(all["scans"], 1);
  EXPECT_EQ(all["detections"][0]["kind"], "valve");
  EXPECT_EQ(all["closed_properly"], true);
  const ProgramResult scan = Mission({"show", first_, "--scan", "1", "--json"});
  ASSERT_EQ(scan.exit_code, 0) << scan.errors;
  EXPECT_EQ(Json(scan)["images"].size(), 1u);
  EXPECT_EQ(Json(scan)["state"], "complete");
  const ProgramResult none = Mission({"show", first_, "--scan", "9"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.errors, HasSubstr("first.foresight: there is no scan 9"));
}

TEST_F(MissionCommand, MergedAndPrunedMissionsDifferFromTheirSourcesAsTheyShould) {
  ASSERT_EQ(Mission({"merge", first_, second_, "-o", In("both.foresight")}).exit_code, 0);
  EXPECT_EQ(Mission({"check", In("both.foresight")}).exit_code, 0);
  ASSERT_EQ(Mission({"prune", In("both.foresight"), "--with-objects", "-o", In("one.foresight")})
                .exit_code,
            0);
  EXPECT_THAT(DifferencesFrom("one.foresight"),
              testing::ElementsAre("log only in the second"));  // the log is nobody's scan
  EXPECT_THAT(DifferencesFrom("both.foresight"),
              testing::ElementsAre("scan only in the second", "log only in the second"));
  EXPECT_EQ(Mission({"diff", first_, first_}).exit_code, 0);

  const ProgramResult nothing = Mission({"prune", first_, "-o", In("x.foresight")});
  EXPECT_EQ(nothing.exit_code, 2);
  const ProgramResult unknown = Mission({"prune", first_, "--keep", "4", "-o", In("x.foresight")});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("there is no scan 4"));
  EXPECT_FALSE(fs::exists(In("x.foresight")));
}

TEST_F(MissionCommand, ADamagedMissionIsNamedAndRecovered) {
  std::string bytes = ReadFile(first_).value();
  std::fill_n(bytes.begin(), 4096, '\xa5');  // its table of contents
  std::ofstream(In("torn.foresight"), std::ios::binary) << bytes;
  const ProgramResult check = Mission({"check", In("torn.foresight")});
  EXPECT_EQ(check.exit_code, 3);
  EXPECT_THAT(check.errors, HasSubstr("torn.foresight"));
  EXPECT_THAT(check.output, HasSubstr("is not a mission file"));
  const ProgramResult json = Mission({"check", In("torn.foresight"), "--json"});
  EXPECT_EQ(json.exit_code, 3);
  EXPECT_EQ(Json(json)["readable"], false);
  EXPECT_EQ(Json(json)["damage"][0]["table"], "file");
  const ProgramResult recovered =
      Mission({"recover", In("torn.foresight"), "-o", In("recovered.foresight"), "--json"});
  EXPECT_EQ(recovered.exit_code, 0) << recovered.errors << recovered.output;
  EXPECT_EQ(Json(recovered)["scans"][0]["state"], "complete");
  const ProgramResult diff = Mission({"diff", first_, In("recovered.foresight")});
  EXPECT_EQ(diff.exit_code, 0) << diff.output;
}

TEST_F(MissionCommand, RunGivesTheSameFilesHoweverItIsSplit) {
  ASSERT_EQ(Mission({"run", first_, second_, "-o", In("whole")}).exit_code, 0);
  for (const char* part : {"2/2", "1/2"})
    ASSERT_EQ(Mission({"run", second_, first_, "-o", In("parts"), "--part", part}).exit_code, 0);
  const auto whole = FilesOf(In("whole"));
  EXPECT_EQ(whole.size(), 2u);
  EXPECT_EQ(whole, FilesOf(In("parts")));
  for (const char* part : {"0/2", "3/2", "1", "1/2x", "a/b"}) {
    const ProgramResult bad = Mission({"run", first_, "-o", In("parts"), "--part", part});
    EXPECT_EQ(bad.exit_code, 2) << part;
    EXPECT_THAT(bad.errors, HasSubstr("K/N"));
  }
}

TEST_F(MissionCommand, RunGivesWhatFitGives) {
  ASSERT_EQ(Mission({"run", first_, "-o", In("again")}).exit_code, 0);
  const auto files = FilesOf(In("again"));
  ASSERT_EQ(files.size(), 1u);
  const auto again = nlohmann::json::parse(files.begin()->second);
  const auto fitted = Json(Run({"fit", "valve", first_, "--roi", kValveRegion, "--json"}));
  EXPECT_EQ(again["fits"][0]["answer"]["best"], fitted["best"]);
  EXPECT_EQ(again["fits"][0]["source"], "raw");
  EXPECT_EQ(again["depth_maps"].size(), 1u);

  const ProgramResult other =
      Mission({"run", first_, "-o", In("other"), "--method", "paper", "--source", "depth"});
  ASSERT_EQ(other.exit_code, 0) << other.errors;
  const auto paper = nlohmann::json::parse(FilesOf(In("other")).begin()->second);
  EXPECT_EQ(paper["fits"][0]["source"], "paper");
  EXPECT_NE(paper["depth_maps"][0]["digest"], again["depth_maps"][0]["digest"]);
}

TEST_F(MissionCommand, ASideResultIsKeptBesideTheMissionListedComparedAndMadeAgain) {
  const std::string mission = In("side.foresight"), review = In("side.review.foresight");
  ASSERT_EQ(Mission({"merge", first_, "-o", mission}).exit_code, 0);
  const std::string before = ReadFile(mission).value();
  EXPECT_THAT(Mission({"results", mission}).output, HasSubstr("no side results"));
  const ProgramResult run =
      Mission({"run", mission, "-o", In("side"), "--method", "paper", "--threshold", "0.25",
               "--fit-option", "valve.seed=5", "--keep", "softer"});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(ReadFile(mission).value(), before);
  ASSERT_EQ(Mission({"run", mission, "-o", In("plain")}).exit_code, 0);

  const nlohmann::json results = Json(Mission({"results", mission, "--json"}))["results"];
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0]["name"], "softer");
  EXPECT_THAT(results[0]["differences"].dump(), HasSubstr("method paper instead of foresight"));
  EXPECT_THAT(results[0]["differences"].dump(), HasSubstr("valve: Seed 5"));
  EXPECT_EQ(results[0]["answer"], nlohmann::json::parse(FilesOf(In("side")).begin()->second));

  // A review among the files adds nothing: its fits are of the side result.
  ASSERT_EQ(Mission({"run", mission, review, "-o", In("with_review")}).exit_code, 0);
  EXPECT_EQ(FilesOf(In("with_review")), FilesOf(In("plain")));

  const ProgramResult compared =
      Mission({"compare", mission, "--b", "softer", "-o", In("compared"), "--json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.errors;
  const nlohmann::json json = Json(compared);
  EXPECT_GT(json["depth"]["p95_abs_m"].get<double>(), 0.0);
  EXPECT_GT(json["depth"]["in_both"].get<int>(), 25'000);
  EXPECT_EQ(json["lidar"]["from_first"]["max_m"], 0.0);
  ASSERT_EQ(json["objects"].size(), 1u);
  EXPECT_LT(json["objects"][0]["difference"]["distance_m"].get<double>(), 0.02);
  EXPECT_EQ(json, nlohmann::json::parse(ReadFile(In("compared/comparison.json")).value()));
  for (const char* file : {"a.png", "b.png", "difference.png", "histogram.svg"})
    EXPECT_TRUE(fs::exists(In("compared") + "/" + file)) << file;
  EXPECT_EQ(Mission({"check", "--recompute", review}).exit_code, 0);
  const ProgramResult unknown = Mission({"compare", mission, "--b", "harder"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.errors, HasSubstr("no result 'harder'; there are: original, softer"));
}

TEST_F(MissionCommand, TwoScansOfTwoMissionsAreComparedByTheirClouds) {
  const nlohmann::json json = Json(Mission({"compare", first_, second_, "--json"}));
  EXPECT_TRUE(json["depth"].is_null());
  EXPECT_GT(json["lidar"]["from_first"]["points"].get<int>(), 10'000);
  // One place, and one seed: what both scans saw is the same, the first one saw more.
  EXPECT_EQ(json["lidar"]["from_second"]["median_m"].get<double>(), 0.0);
  EXPECT_LT(json["lidar"]["from_first"]["median_m"].get<double>(), 0.03);
  EXPECT_GT(json["lidar"]["from_first"]["max_m"].get<double>(), 0.03);
  ASSERT_EQ(json["objects"].size(), 1u);
  EXPECT_TRUE(json["objects"][0]["second"].is_null());  // nothing was fitted in the second
}

TEST_F(MissionCommand, WrongOptionsOfARunAreNamed) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"seed=5", "KIND.KEY=VALUE"},
      {"boat.seed=5", "boat"},
      {"valve.nothing=5", "no option 'nothing'"},
      {"valve.seed=x", "valve.seed=x"}};
  for (const auto& [option, words] : wrong) {
    const ProgramResult run = Mission({"run", first_, "-o", In("wrong"), "--fit-option", option});
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_THAT(run.errors, HasSubstr(words));
  }
  EXPECT_EQ(Mission({"run", first_, "-o", In("wrong"), "--scan", "7"}).exit_code, 3);
  EXPECT_EQ(Mission({"results", first_, "--scan", "7"}).exit_code, 3);
}

TEST_F(MissionCommand, AReportIsAPageWithPicturesAndAPdf) {
  const ProgramResult report = Mission({"report", first_, "-o", In("report"), "--pdf", "--json"});
  ASSERT_EQ(report.exit_code, 0) << report.errors;
  const nlohmann::json json = Json(report);
  EXPECT_EQ(json["objects"], 1);
  for (const auto& file : json["files"])
    EXPECT_TRUE(fs::exists(fs::path(In("report")) / file.get<std::string>())) << file;
  EXPECT_THAT(ReadFile(In("report/report.html")).value(), HasSubstr("lidar returns"));
  EXPECT_THAT(ReadFile(In("report/report.pdf")).value(), testing::StartsWith("%PDF"));
  EXPECT_LT(fs::file_size(In("report/report.pdf")), 400'000u);
  EXPECT_EQ(Mission({"report", first_, "--scan", "9", "-o", In("report")}).exit_code, 3);
}

/// A disk that is full: files cannot grow beyond a size. What is there already stays as it was.
class FullDisk : public MissionCommand {
 protected:
  /// Runs it with room, and again without: the files of the first run are the same afterwards.
  void ExpectOldFilesStay(const std::vector<std::string>& arguments, const std::string& out) {
    const ProgramResult roomy = Run(arguments);
    ASSERT_LE(roomy.exit_code, 1) << roomy.errors;
    const auto before = FilesOf(out);
    ASSERT_FALSE(before.empty());
    const std::string mission = ReadFile(first_).value();
    std::size_t largest = 0;
    for (const auto& [name, content] : before) largest = std::max(largest, content.size());
    for (const std::size_t bytes : {std::size_t{2'000}, largest / 3, largest * 3 / 4}) {
      const ProgramResult full = RunProgram(FORESIGHTCTL, arguments, {.file_bytes = bytes});
      EXPECT_EQ(full.exit_code, 3) << bytes << full.output;
      EXPECT_EQ(full.ErrorLines(), 1) << full.errors;
      EXPECT_THAT(full.errors, HasSubstr(out)) << "the error names the file";
      const auto after = FilesOf(out);
      for (const auto& [name, content] : after) {
        const auto old = before.find(name);
        ASSERT_NE(old, before.end()) << name << " was left behind, " << content.size() << " bytes";
        // PDF and JSON may hold a time.
        EXPECT_GE(content.size() + 64, old->second.size()) << name << " was written by half";
      }
      EXPECT_EQ(after.size(), before.size());
      EXPECT_EQ(ReadFile(first_).value(), mission);
    }
  }
};

TEST_F(FullDisk, AnExportLeavesTheOneBefore) {
  ExpectOldFilesStay({"mission", "export", first_, "-o", In("full-export"), "--what", "all"},
                     In("full-export"));
}

TEST_F(FullDisk, AReportLeavesTheOneBefore) {
  ExpectOldFilesStay({"mission", "report", first_, "-o", In("full-report"), "--pdf"},
                     In("full-report"));
}

TEST_F(FullDisk, AMapLeavesTheOneBefore) {
  fs::create_directory(In("full-map"));
  for (const char* name : {"map.ply", "map.pcd"})
    ExpectOldFilesStay({"map", first_, "-o", In("full-map") + "/" + name}, In("full-map"));
}

TEST_F(FullDisk, AComparisonLeavesTheOneBefore) {
  ExpectOldFilesStay({"mission", "compare", first_, "--b", "original", "-o", In("full-compare")},
                     In("full-compare"));
}

TEST_F(FullDisk, ASideResultIsKeptWholeOrNotAtAll) {
  const std::string copy = In("full-run.foresight"), out = In("full-run");
  fs::copy_file(first_, copy);
  const std::string mission = ReadFile(copy).value();
  const ProgramResult full = RunProgram(
      FORESIGHTCTL, {"mission", "run", copy, "-o", out, "--keep", "x"}, {.file_bytes = 9'000});
  EXPECT_EQ(full.exit_code, 3) << full.output;
  EXPECT_EQ(full.ErrorLines(), 1) << full.errors;
  EXPECT_EQ(ReadFile(copy).value(), mission);
  EXPECT_EQ(Mission({"results", copy}).output, "no side results\n");
  const ProgramResult roomy = Mission({"run", copy, "-o", out, "--keep", "x"});
  EXPECT_LE(roomy.exit_code, 1) << roomy.errors;
  EXPECT_THAT(Mission({"results", copy}).output, HasSubstr(" x "));
}

TEST_F(FullDisk, AnImportLeavesNoMissionBehind) {
  ASSERT_EQ(Mission({"export", first_, "-o", In("for-import"), "--what", "ply"}).exit_code, 0);
  const std::string target = In("full-import/m.foresight");
  fs::create_directory(In("full-import"));
  const ProgramResult full = RunProgram(
      FORESIGHTCTL, {"mission", "import", In("for-import"), "-o", target}, {.file_bytes = 60'000});
  EXPECT_EQ(full.exit_code, 3) << full.output;
  EXPECT_EQ(full.ErrorLines(), 1) << full.errors;
  EXPECT_TRUE(FilesOf(In("full-import")).empty());
}

TEST_F(MissionCommand, ASideResultIsRenamedAndDeletedByName) {
  const std::string copy = In("renamed.foresight");
  fs::copy_file(first_, copy);
  ASSERT_LE(Mission({"run", copy, "-o", In("renamed-run"), "--keep", "x"}).exit_code, 1);
  EXPECT_EQ(Mission({"results", copy, "--rename", "x"}).exit_code, 2);
  EXPECT_EQ(Mission({"results", copy, "--rename", "none", "--to", "y"}).exit_code, 3);
  ASSERT_EQ(Mission({"results", copy, "--rename", "x", "--to", "soft edges"}).exit_code, 0);
  const nlohmann::json results = Json(Mission({"results", copy, "--json"}))["results"];
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0]["name"], "soft edges");
  const std::string uuid = results[0]["uuid"];
  ASSERT_EQ(Mission({"results", copy, "--delete", uuid.substr(0, 8)}).exit_code, 0);
  EXPECT_EQ(Mission({"results", copy}).output, "no side results\n");
  EXPECT_EQ(Mission({"compare", copy, "--b", "soft edges"}).exit_code, 3);
}

TEST_F(MissionCommand, AReaderInPythonThatKnowsOnlyTheDocumentationReadsTheSame) {
  const ProgramResult read =
      RunProgram("/usr/bin/python3", {FORESIGHT_SOURCE_DIR "/docs/read_mission.py", first_});
  ASSERT_EQ(read.exit_code, 0) << read.errors;
  const Scan scan = MissionFile::OpenReadOnly(first_).value()->LoadScan(1).value();
  EXPECT_THAT(read.output, testing::StartsWith("scan 1 " + scan.uuid + " complete\nmotor "));
  const std::string reader = ReadFile(FORESIGHT_SOURCE_DIR "/docs/read_mission.py").value();
  EXPECT_LE(std::count(reader.begin(), reader.end(), '\n'), 20);
  for (const LidarLine& line : scan.lines)
    ASSERT_THAT(read.output,
                HasSubstr(fmt::format(
                    " {} {}\n", std::accumulate(line.range_mm.begin(), line.range_mm.end(), 0),
                    std::accumulate(line.intensity.begin(), line.intensity.end(), 0))));
}

TEST_F(MissionCommand, MapBringsScansTogetherAndFindsNoChangeWhereThereIsNone) {
  const std::string both = In("for_map.foresight"), cloud = In("map.ply");
  ASSERT_EQ(Mission({"merge", first_, second_, "-o", both}).exit_code, 0);
  std::ofstream(In("odometry.csv")) << "scan,x_m,y_m,z_m,qw,qx,qy,qz\n1,5,0,0,1,0,0,0\n"
                                       "2,5.03,0.02,0,1,0,0,0\n";
  const ProgramResult map = Run({"map", both, "--odometry", In("odometry.csv"), "--out", cloud,
                                 "--changes", "1,2", "--json"});
  ASSERT_EQ(map.exit_code, 0) << map.errors << map.output;
  const nlohmann::json json = Json(map);
  const auto& place = json["scans"][1]["map_from_robot"]["translation_m"];
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(place[axis].get<double>(), 0.0, 0.005);
  EXPECT_EQ(json["changes"].size(), 0u) << map.output;
  EXPECT_GT(fs::file_size(cloud), 100'000u);

  std::ofstream(In("bad.csv")) << "scan,x_m,y_m,z_m,qw,qx,qy,qz\n1,0,0,0,0,0,0,0\n";
  const ProgramResult bad = Run({"map", both, "--odometry", In("bad.csv")});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.errors, HasSubstr("bad.csv:2: the quaternion"));
}

TEST_F(MissionCommand, ANoteIsKeptShownFoundChangedAndDeleted) {
  const std::string file = In("noted/noted.foresight");
  fs::create_directories(In("noted"));
  fs::copy_file(second_, file);
  const ProgramResult kept =
      Mission({"note", file, "the rim is bent", "--scan", "1", "--tags", "#Crack, rim", "--json"});
  ASSERT_EQ(kept.exit_code, 0) << kept.errors;
  EXPECT_EQ(Json(kept)["tags"], "crack rim");
  const std::string uuid = Json(kept)["uuid"];
  ASSERT_EQ(Mission({"note", file, "windy today"}).exit_code, 0);

  const auto show = [&] { return Json(Mission({"show", file, "--json"}))["notes"]; };
  ASSERT_EQ(show().size(), 2u);
  EXPECT_EQ(show()[0]["text"], "the rim is bent");
  EXPECT_EQ(show()[0]["scan"], 1);
  EXPECT_NE(show()[0]["made_by"], "");
  EXPECT_EQ(Json(Mission({"show", file, "--scan", "1", "--json"}))["notes"].size(), 1u);
  EXPECT_THAT(Mission({"show", file}).output, HasSubstr("note of the mission, "));

  const auto found = [&] { return Mission({"search", In("noted"), "#crack", "--what", "note"}); };
  EXPECT_EQ(found().exit_code, 0);
  ASSERT_EQ(Mission({"note", file, "it is only paint", "--change", uuid}).exit_code, 0);
  EXPECT_EQ(show()[0]["text"], "it is only paint");
  EXPECT_EQ(show()[0]["tags"], "crack rim") << "tags that were not given stay";
  EXPECT_THAT(found().output, HasSubstr("it is only paint"));
  ASSERT_EQ(Mission({"note", file, "--delete", uuid}).exit_code, 0);
  EXPECT_EQ(show().size(), 1u);
  EXPECT_EQ(found().exit_code, 1);

  EXPECT_EQ(Mission({"note", file}).exit_code, 2);
  const ProgramResult lost = Mission({"note", file, "where?", "--scan", "9"});
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_THAT(lost.errors, HasSubstr("there is no scan 9 for a note"));
  EXPECT_EQ(Mission({"note", file, "what?", "--object", "77"}).exit_code, 3);
}

TEST_F(MissionCommand, ExportWritesWhatIsAskedFor) {
  const ProgramResult exported =
      Mission({"export", first_, "-o", In("export"), "--what", "pcd,tables,bag", "--json"});
  ASSERT_EQ(exported.exit_code, 0) << exported.errors;
  EXPECT_THAT(
      Json(exported)["files"],
      testing::UnorderedElementsAre("scans.csv", "detections.csv", "notes.csv", "events.csv",
                                    "scan-0001/cloud.pcd", "scan-0001/scan.json", "mission.bag"));
  const ProgramResult unknown = Mission({"export", first_, "-o", In("export"), "--what", "dxf"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("surface-gltf"));
}

}  // namespace
}  // namespace foresight
