// foresight-head and foresightctl over the link, as two programs.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/running_program.h"

namespace foresight {
namespace {

using testing::HasSubstr;

const std::string kRoom = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";

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
  std::vector<std::string> DigestsOf(const std::filesystem::path& mission) const {
    std::vector<std::string> digests;
    const ProgramResult shown =
        RunProgram(FORESIGHTCTL, {"mission", "digest", mission.string(), "--json"});
    const auto json = nlohmann::json::parse(shown.output, nullptr, false);
    if (!json.is_object()) return digests;
    for (const auto& scan : json["scans"]) digests.push_back(scan["digest"]);
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
  RunningProgram head(FORESIGHT_HEAD, {"--emulate", kRoom, "--listen", "127.0.0.1:0", "--plaintext",
                                       "--scans", folder / "scans", "--json"});
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
  RunningProgram head(FORESIGHT_HEAD, {"--emulate", kRoom, "--listen", "127.0.0.1:0", "--plaintext",
                                       "--scans", scans, "--json"});
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

TEST_F(LinkedPrograms, WithoutEncryptionOnlyThisComputerIsServed) {
  const ProgramResult head = RunProgram(
      FORESIGHT_HEAD,
      {"--emulate", kRoom, "--listen", "0.0.0.0:0", "--plaintext", "--scans", folder / "scans"});
  EXPECT_NE(head.exit_code, 0);
  EXPECT_THAT(head.errors, HasSubstr("make keys with foresightctl pki"));
}

TEST_F(LinkedPrograms, AHeadWithoutKeysSaysWhereTheyAreMissing) {
  const ProgramResult head =
      RunProgram(FORESIGHT_HEAD, {"--emulate", kRoom, "--listen", "127.0.0.1:0", "--link-keys",
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
