// foresight-head and foresightctl over the link, as two programs.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/calibration/session_folder.h"
#include "tests/support/running_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// Where two documents differ by more than the last digits of a number; "" = nowhere. What crosses
/// the link is read from JSON and made into rotations again.
std::string Difference(const nlohmann::json& a, const nlohmann::json& b) {
  if (a.is_number() && b.is_number())
    return std::abs(a.get<double>() - b.get<double>()) < 1e-12 ? "" : a.dump() + " " + b.dump();
  if (!a.is_structured() || a.size() != b.size() || a.type() != b.type())
    return a == b ? "" : a.dump() + " " + b.dump();
  const nlohmann::json flat_a = a.flatten();
  const nlohmann::json flat_b = b.flatten();
  if (flat_a.size() != flat_b.size()) return "other members";
  for (const auto& [key, value] : flat_a.items()) {
    const std::string difference =
        flat_b.contains(key) ? Difference(value, flat_b[key]) : "is missing";
    if (!difference.empty()) return key + ": " + difference;
  }
  return "";
}

class LinkedPrograms : public testing::Test {
 protected:
  /// Empty where it does not listen.
  static std::string AddressOf(const RunningProgram& head) {
    std::string address;
    WaitUntil([&] {
      const auto json = nlohmann::json::parse(head.Output(), nullptr, false);
      if (json.is_object()) address = json.value("address", "");
      return !address.empty();
    });
    return address;
  }
  static nlohmann::json ScansOf(const std::filesystem::path& mission) {
    const ProgramResult shown =
        RunProgram(FORESIGHTCTL, {"mission", "digest", mission.string(), "--json"});
    const auto json = nlohmann::json::parse(shown.output, nullptr, false);
    return json.is_object() ? json.value("scans", nlohmann::json::array())
                            : nlohmann::json::array();
  }
  static std::vector<std::string> DigestsOf(const std::filesystem::path& mission) {
    std::vector<std::string> digests;
    for (const auto& scan : ScansOf(mission)) digests.push_back(scan["digest"]);
    return digests;
  }
  std::filesystem::path OnlyScanOfHead() const {
    for (const auto& file : std::filesystem::directory_iterator(folder / "scans"))
      if (file.path().extension() == ".foresight") return file.path();
    return {};
  }

  const TemporaryFolder folder;
};

TEST_F(LinkedPrograms, AScanOverTheLinkIsTheOneOfTheHead) {
  RunningProgram head(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--listen", "127.0.0.1:0",
                                       "--plaintext", "--scans", folder / "scans", "--json"});
  const std::string address = AddressOf(head);
  ASSERT_NE(address, "");
  const ProgramResult scan =
      RunProgram(FORESIGHTCTL, {"scan", "--head", address, "--plaintext", "--from", "-3", "--to",
                                "3", "--out", folder / "station.foresight"});
  ASSERT_EQ(scan.exit_code, 0) << scan.errors;
  EXPECT_THAT(scan.output, HasSubstr(" complete, "));
  const auto here = DigestsOf(folder / "station.foresight");
  ASSERT_EQ(here.size(), 1u);
  EXPECT_EQ(here, DigestsOf(OnlyScanOfHead()));
  head.Signal(SIGTERM);
  const ProgramResult ended = head.Wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.errors, HasSubstr("local has all of scan"));
}

TEST_F(LinkedPrograms, FetchBringsWhatTheHeadKeeps) {
  const std::string scans = folder / "scans";
  RunningProgram head(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--listen", "127.0.0.1:0",
                                       "--plaintext", "--scans", scans, "--json"});
  const std::vector<std::string> link = {"--head", AddressOf(head), "--plaintext"};
  const auto fetch = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "fetch");
    arguments.insert(arguments.end(), link.begin(), link.end());
    return RunProgram(FORESIGHTCTL, arguments);
  };
  EXPECT_EQ(fetch({"--list"}).exit_code, 1) << "nothing there is a negative result";
  ASSERT_EQ(RunProgram(FORESIGHTCTL, {"scan", link[0], link[1], link[2], "--from", "-3", "--to",
                                      "3", "--out", folder / "station.foresight"})
                .exit_code,
            0);
  const ProgramResult listed = fetch({"--list", "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.errors;
  const auto list = nlohmann::json::parse(listed.output);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_GT(list[0]["lines"], 0);

  const ProgramResult unknown = fetch({"--scan", "none", "--out", folder / "again.foresight"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.errors, HasSubstr("the head has no scan 'none'"));
  const ProgramResult fetched =
      fetch({"--scan", list[0]["scan"], "--out", folder / "again.foresight", "--json"});
  ASSERT_EQ(fetched.exit_code, 0) << fetched.errors;
  EXPECT_EQ(nlohmann::json::parse(fetched.output)[0]["scan"], list[0]["scan"]);
  EXPECT_EQ(DigestsOf(folder / "again.foresight"), DigestsOf(folder / "station.foresight"));
  EXPECT_FALSE(std::filesystem::exists(folder / "again.foresight.spool"));
}

TEST_F(LinkedPrograms, FetchSaysWhatItNeeds) {
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"fetch", "--head", "127.0.0.1"}).exit_code, 2);
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"fetch", "--out", folder / "a.foresight"}).exit_code, 2);
}

TEST_F(LinkedPrograms, AFitOnTheHeadIsTheFitHere) {
  RunningProgram head(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--listen", "127.0.0.1:0",
                                       "--plaintext", "--scans", folder / "scans", "--json"});
  const std::vector<std::string> link = {"--head", AddressOf(head), "--plaintext"};
  const auto run = [](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  };
  const std::string mission = folder / "station.foresight";
  ASSERT_EQ(run({"scan", "--from", "-20", "--to", "20", "--images", "0", "--out", mission}, link)
                .exit_code,
            0);
  for (const std::string source : {"raw", "foresight"}) {
    const std::vector<std::string> fit = {"fit",  "terrain", "--roi",  "400",      "600",
                                          "1000", "1000",    "--json", "--source", source};
    const ProgramResult here = run(fit, {mission});
    const ProgramResult there = run(fit, link);
    EXPECT_EQ(there.exit_code, here.exit_code) << there.errors;
    auto found_here = nlohmann::json::parse(here.output);
    auto found_there = nlohmann::json::parse(there.output);
    ASSERT_TRUE(found_here.contains("verdict")) << here.output;
    found_here.erase("seconds");
    found_there.erase("seconds");
    found_there.erase("link_bytes");
    EXPECT_EQ(Difference(found_there, found_here), "") << source;
  }
  const ProgramResult unknown =
      run({"fit", "terrain", "--roi", "400", "600", "1000", "1000", "--head-scan", "none"}, link);
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_EQ(unknown.ErrorLines(), 1) << unknown.errors;
  EXPECT_THAT(unknown.errors, HasSubstr("no scan"));

  const std::string png = folder / "image.png";
  const ProgramResult image =
      run({"image", "--out", png, "--part", "100", "200", "300", "150"}, link);
  ASSERT_EQ(image.exit_code, 0) << image.errors;
  const std::string all = folder / "all.jpg";
  ASSERT_EQ(run({"image", "--out", all, "--largest-side", "320"}, link).exit_code, 0);
  EXPECT_EQ(run({"image", "--out", all, "--number", "9"}, link).exit_code, 3);
}

/// The station dies in the middle of a scan, and then the head: nothing is lost, nothing doubled.
TEST_F(LinkedPrograms, ADeathLosesNothingAndDoublesNothing) {
  const std::vector<std::string> daemon = {"--emulate",     kRoomScene, "--plaintext",
                                           "--no-announce", "--scans",  folder / "scans",
                                           "--json",        "--listen"};
  const auto start = [&](const std::string& address) {
    std::vector<std::string> arguments = daemon;
    arguments.push_back(address);
    return std::make_unique<RunningProgram>(FORESIGHT_HEAD, arguments);
  };
  auto head = start("127.0.0.1:0");
  const std::string address = AddressOf(*head);
  ASSERT_NE(address, "");
  const std::string mission = folder / "station.foresight";
  const std::vector<std::string> scan = {"scan",   "--from", "-10",         "--to",  "10",
                                         "--head", address,  "--plaintext", "--out", mission};
  const auto some_lines = [&] {
    return WaitUntil([&] {
      const auto scans = ScansOf(OnlyScanOfHead());
      return !scans.empty() && scans[0]["lines"] >= 4;
    });
  };
  {
    RunningProgram station(FORESIGHTCTL, scan);
    ASSERT_TRUE(some_lines());
    station.Signal(SIGKILL);
    station.Wait();
  }
  head->Signal(SIGKILL);
  head->Wait();
  head = start(address);
  ASSERT_EQ(AddressOf(*head), address);
  const ProgramResult fetched =
      RunProgram(FORESIGHTCTL, {"fetch", "--head", address, "--plaintext", "--out", mission});
  ASSERT_EQ(fetched.exit_code, 0) << fetched.errors;
  const auto here = DigestsOf(mission);
  EXPECT_EQ(here.size(), 1u);
  EXPECT_EQ(here, DigestsOf(OnlyScanOfHead()));
  EXPECT_FALSE(std::filesystem::exists(mission + ".spool"));
}

TEST_F(LinkedPrograms, StopEndsASweepOfWhoeverHasControl) {
  RunningProgram head(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--listen", "127.0.0.1:0",
                                       "--plaintext", "--scans", folder / "scans", "--json"});
  const std::string address = AddressOf(head);
  ASSERT_NE(address, "");
  RunningProgram station(FORESIGHTCTL, {"scan", "--head", address, "--plaintext", "--from", "-30",
                                        "--to", "80", "--out", folder / "station.foresight"});
  ASSERT_TRUE(WaitUntil([&] {
    const auto scans = ScansOf(OnlyScanOfHead());
    return !scans.empty() && scans[0]["lines"] >= 4;
  }));
  const ProgramResult stopped =
      RunProgram(FORESIGHTCTL, {"stop", "--head", address, "--plaintext", "--json"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped.errors;
  EXPECT_EQ(nlohmann::json::parse(stopped.output).at("stopped"), true);
  EXPECT_NE(station.Wait().exit_code, 0);
  const auto scans = ScansOf(OnlyScanOfHead());
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0]["state"], "aborted");
  EXPECT_LT(scans[0]["lines"], 400);
}

/// Neither takes control from whoever has it.
TEST_F(LinkedPrograms, HealthAndACalibrationSessionComeOverTheLink) {
  RunningProgram head(
      FORESIGHT_HEAD,
      {"--emulate", FORESIGHT_SOURCE_DIR "/resources/scenes/calibration.yaml", "--listen",
       "127.0.0.1:0", "--plaintext", "--scans", folder / "scans", "--json"});
  const std::vector<std::string> link = {"--head", AddressOf(head), "--plaintext"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), link.begin(), link.end());
    return RunProgram(FORESIGHTCTL, arguments);
  };
  // The stand of the head's world goes there by itself.
  const ProgramResult recorded = run({"calibrate", "record", folder / "session", "--stops",
                                      "0:10:10", "--lines", "2", "--places", "21", "--json"});
  ASSERT_EQ(recorded.exit_code, 0) << recorded.errors;
  const auto tally = nlohmann::json::parse(recorded.output);
  const auto session = SessionFolder::Open(folder / "session");
  ASSERT_TRUE(session);
  ASSERT_EQ(session->Index().poses.size(), 1u);
  EXPECT_EQ(session->Index().poses[0].name, "pose 1");
  EXPECT_EQ(tally.at("stops"), 2);
  EXPECT_EQ(tally.at("images"), 2);
  EXPECT_EQ(tally.at("sweeps"), 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "session.spool"));

  const ProgramResult health = run({"health", "--seconds", "1", "--json"});
  const auto line = nlohmann::json::parse(health.output);
  // On a busy machine devices answer slowly, and the exit code says so too.
  EXPECT_EQ(health.exit_code, line.at("condition") == "well" ? 0 : 1) << health.output;
  for (const char* device : {"lidar", "camera", "motor"})
    EXPECT_NE(line.at(device).at("condition"), "missing") << health.output;
  EXPECT_EQ(line.at("link").at("connected"), true);
  head.Signal(SIGTERM);
  EXPECT_EQ(head.Wait().exit_code, 0);
}

TEST_F(LinkedPrograms, StopSaysThatNobodyAnswers) {
  const ProgramResult stopped = RunProgram(
      "/usr/bin/timeout",
      {"--signal=INT", "3", FORESIGHTCTL, "stop", "--head", "127.0.0.1:1", "--plaintext"});
  EXPECT_THAT(stopped.errors, HasSubstr("the head has not answered the stop"));
  EXPECT_EQ(stopped.ErrorLines(), 1) << stopped.errors;
}

TEST_F(LinkedPrograms, WithoutEncryptionOnlyThisComputerIsServed) {
  const ProgramResult head =
      RunProgram(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--listen", "0.0.0.0:0", "--plaintext",
                                  "--scans", folder / "scans"});
  EXPECT_NE(head.exit_code, 0);
  EXPECT_THAT(head.errors, HasSubstr("make keys with foresightctl pki"));
}

TEST_F(LinkedPrograms, AHeadWithoutKeysSaysWhereTheyAreMissing) {
  const ProgramResult head =
      RunProgram(FORESIGHT_HEAD, {"--emulate", kRoomScene, "--listen", "127.0.0.1:0", "--link-keys",
                                  folder / "none", "--scans", folder / "scans"});
  EXPECT_EQ(head.exit_code, 3);
  EXPECT_THAT(head.errors, HasSubstr((folder / "none").string()));
}

TEST_F(LinkedPrograms, AnAddressThatIsNoneIsWrongUsage) {
  for (const char* address : {"host:", "host:99999", "a:b:c", ":5"}) {
    const ProgramResult scan = RunProgram(FORESIGHTCTL, {"scan", "--head", address, "--plaintext",
                                                         "--out", folder / "station.foresight"});
    EXPECT_EQ(scan.exit_code, 2) << address << ": " << scan.errors;
    EXPECT_EQ(scan.ErrorLines(), 1) << scan.errors;
  }
}

}  // namespace
}  // namespace foresight
