// What a command line that makes no sense is told, and that what is said can be read by programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Wrong usage: exit 2, and one line on standard error that holds `what`.
void ExpectUsage(const ProgramResult& result, const std::string& what) {
  EXPECT_EQ(result.exit_code, 2) << result.errors;
  EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr(what));
}

TEST(CommandLine, AnUnknownCommandIsNamedWithTheOneThatWasMeant) {
  ExpectUsage(Ctl({"dpeth"}), "'dpeth' is no command; did you mean 'depth'?");
  ExpectUsage(Ctl({"fit", "vlave"}), "'vlave' is no command; did you mean 'valve'?");
  const ProgramResult far = Ctl({"launch-the-rocket", "--json"});
  ExpectUsage(far, "'launch-the-rocket' is no command; there are scan, depth");
  EXPECT_THAT(far.errors, Not(HasSubstr("did you mean")));
}

TEST(CommandLine, AMissingCommandIsToldWhichThereAre) {
  ExpectUsage(Ctl({}), "a command is missing: one of scan, depth");
  ExpectUsage(Ctl({"fit"}), "'fit' needs a command: one of valve, drill");
}

TEST(CommandLine, ASeedIsAWholeNumberWithoutASign) {
  for (const char* seed : {"-1", "18446744073709551616", "1.5", "one"})
    ExpectUsage(Ctl({"render", kValveScene, "--seed=" + std::string(seed)}), "is no seed");
  ExpectUsage(Ctl({"evaluate-fits", "valve", "--first-seed=-1"}), "is no seed");
  ExpectUsage(RunProgram(FORESIGHT_HEAD,
                         {"--emulate", kValveScene, "--scan", "p", "--out", "o", "--seed=-1"}),
              "is no seed");
}

TEST(CommandLine, ScansCountFromOne) {
  ExpectUsage(Ctl({"depth", "mission", "--scan", "0"}), "--scan");
  ExpectUsage(Ctl({"depth", "mission", "--scan", "-3"}), "--scan");
}

TEST(CommandLine, NumbersAreFinite) {
  ExpectUsage(Ctl({"render", kValveScene, "--angle", "nan"}),
              "--angle: 'nan' is not a finite number");
  ExpectUsage(Ctl({"render", kValveScene, "--angle=inf"}), "--angle");
  ExpectUsage(Ctl({"fit", "drill", "--cloud", "a.ply", "--viewpoint", "0,1e999,0"}), "--viewpoint");
}

TEST(CommandLine, WhatDoesNotApplyIsRefusedNotIgnored) {
  const std::vector<std::string> cloud = {"fit",   "valve",       "--cloud",
                                          "a.ply", "--viewpoint", "0,0,0"};
  const std::vector<std::string> map = {"fit",   "valve",    "--depth", "a.pfm",
                                        "--rig", "rig.yaml", "--roi",   "1,1,90,90"};
  const std::vector<std::string> scan = {"fit", "valve", "a.foresight", "--roi", "1,1,90,90"};
  const auto with = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
    return Ctl(command);
  };
  for (const auto& more :
       std::vector<std::vector<std::string>>{{"--source", "raw"},
                                             {"--density", "0.1"},
                                             {"--method", "paper"},
                                             {"--scan", "1"},
                                             {"--image", "0"},
                                             {"--iterations", "2"},
                                             {"--rig", "r.yaml", "--up", "0,0,1"}})
    ExpectUsage(with(cloud, more), more[more.size() - 2]);
  for (const auto& more : std::vector<std::vector<std::string>>{{"--source", "raw"},
                                                                {"--viewpoint", "0,0,0"},
                                                                {"--up", "0,0,1"},
                                                                {"--threshold", "0.1"},
                                                                {"--scan", "1"}})
    ExpectUsage(with(map, more), more[0]);
  for (const auto& more :
       std::vector<std::vector<std::string>>{{"--viewpoint", "0,0,0"},
                                             {"--up", "0,0,1"},
                                             {"--density", "0.1"},
                                             {"--rig", "r.yaml"},
                                             {"--method", "paper"},
                                             {"--method", "paper", "--source", "foresight"}})
    ExpectUsage(with(scan, more), more[0]);
}

TEST(CommandLine, WithJsonAnErrorIsJsonToo) {
  const ProgramResult data = Ctl({"depth", "/missing/a.foresight", "--json"});
  EXPECT_EQ(data.exit_code, 3);
  EXPECT_EQ(data.ErrorLines(), 1) << data.errors;
  const auto error = nlohmann::json::parse(data.output)["error"];
  EXPECT_EQ(error["code"], "file_error");
  EXPECT_THAT(data.errors, HasSubstr(error["message"].get<std::string>()));
  const ProgramResult usage = Ctl({"depth", "--json", "--no-such-option"});
  EXPECT_EQ(usage.exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(usage.output)["error"]["code"], "invalid_options");
}

TEST(CommandLine, ControlBytesAndBytesThatAreNoUtf8AreEscaped) {
  const std::string name = "/missing/\x1b[2J\n\xff.png";
  const ProgramResult result = Ctl({"upsample", name, "samples.csv", "--json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("\\x1b[2J\\n\\xff.png"));
  EXPECT_THAT(result.errors, Not(HasSubstr("\x1b")));
  EXPECT_THAT(nlohmann::json::parse(result.output)["error"]["message"].get<std::string>(),
              HasSubstr("\\x1b[2J\\n\\xff.png"));
}

TEST(CommandLine, AResultInAFolderOfAnyNameIsStillJson) {
  const TemporaryFolder folder;
  const std::string out = folder / "caf\xe9";
  const ProgramResult result = Ctl({"render", kValveScene, "--out", out, "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NO_THROW(nlohmann::json::parse(result.output)) << result.output;
}

}  // namespace
}  // namespace foresight
