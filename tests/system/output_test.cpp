// What cannot be written is an error; what stands where a file should go is left as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/io/png.h"
#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kPredict = {"scan", "--predict", "--json"};

/// Exit 3, and a last line on standard error that says `what`; notes may come before it.
void ExpectLost(const ProgramResult& result, const std::string& what) {
  EXPECT_EQ(result.exit_code, 3) << result.errors;
  EXPECT_THAT(result.errors, testing::ContainsRegex("foresight[^\n]*: [^\n]*\n$"));
  EXPECT_THAT(result.errors, HasSubstr(what));
}

TEST(Output, AFullDiskBehindStandardOutputIsAnError) {
  for (const auto& command : std::vector<std::vector<std::string>>{
           kPredict, {"scan", "--predict"}, {"--help"}, {"--version"}})
    ExpectLost(RunProgram(FORESIGHTCTL, command, {.output = "/dev/full"}),
               "standard output: cannot write: No space left on device");
  ExpectLost(RunProgram(FORESIGHT_HEAD, {"--help"}, {.output = "/dev/full"}), "standard output");
}

TEST(Output, AClosedStandardOutputIsAnErrorAndNoFileTakesItsPlace) {
  ExpectLost(RunProgram(FORESIGHTCTL, kPredict, {.no_output = true}), "standard output");
  const TemporaryFolder folder;
  const std::string mission = folder / "a.foresight";
  ExpectLost(RunProgram(FORESIGHTCTL,
                        {"scan", "--scene", kValveScene, "--from", "-1", "--to", "1", "--speed",
                         "40", "--out", mission, "--json"},
                        {.no_output = true}),
             "standard output");
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"cloud", mission, "--out", folder / "a.ply"}).exit_code, 0)
      << "the scan is kept, and nothing was printed into it";
}

TEST(Output, AReaderThatIsGoneIsAnErrorNotTheEndByASignal) {
  ExpectLost(RunProgram(FORESIGHTCTL, kPredict, {.no_reader = true}),
             "standard output: cannot write: Broken pipe");
}

TEST(Output, HealthThatNobodyReadsEnds) {
  const ProgramResult result = RunProgram(FORESIGHTCTL, {"health", "--emulate", kValveScene},
                                          {.seconds = 60, .no_reader = true});
  ExpectLost(result, "standard output: cannot write: Broken pipe");
}

TEST(Output, ATableThatCannotGrowIsAnError) {
  const TemporaryFolder folder;
  const std::string table = folder / "table.jsonl";
  const std::vector<std::string> trials = {
      "evaluate-fits", "valve", "--count", "2", "--source", "raw", "--table", table, "--json"};
  const ProgramResult full = RunProgram(FORESIGHTCTL, trials, {.file_bytes = 300});
  EXPECT_EQ(full.exit_code, 3) << full.errors;
  EXPECT_THAT(full.errors, HasSubstr("table.jsonl: cannot write: File too large"));
  // What was cut is made again where there is room.
  EXPECT_EQ(RunProgram(FORESIGHTCTL, trials).exit_code, 0);
}

TEST(Output, AFileThatDoesNotFitLeavesTheOldOne) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "image.png", "old"));
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"render", kValveScene, "--out", folder.path().string()},
                 {.file_bytes = 10'000});
  ExpectLost(result, "image.png: cannot write: File too large");
  EXPECT_EQ(ReadFile(folder / "image.png").value(), "old");
  EXPECT_EQ(folder.EntryCount(), 1);
}

/// One scan for the tests below.
class OutputFiles : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const ProgramResult scanned =
        RunProgram(FORESIGHTCTL, {"scan", "--scene", kValveScene, "--from", "-15", "--to", "15",
                                  "--speed", "30", "--out", *folder_ / "a.foresight"});
    ASSERT_EQ(scanned.exit_code, 0) << scanned.errors;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ProgramResult FitWithPicture(const std::string& picture) {
    return RunProgram(FORESIGHTCTL, {"fit", "valve", *folder_ / "a.foresight", "--roi",
                                     "534,413,721,602", "--picture", picture});
  }
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(OutputFiles, ADeviceStaysADevice) {
  // As root a rename would replace the node itself; a link to it stands for it here.
  const std::string link = *folder_ / "null.png";
  std::filesystem::create_symlink("/dev/null", link);
  ExpectLost(FitWithPicture(link), "null.png: is a device");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  ExpectLost(FitWithPicture("/dev/stdout"), "/dev/stdout: is an open stream, not a file");
}

TEST_F(OutputFiles, AnImageIsWrittenThroughALink) {
  const std::string link = *folder_ / "link.png";
  std::filesystem::create_symlink("real.png", link);
  ASSERT_LE(FitWithPicture(link).exit_code, 1);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(ReadPng(*folder_ / "real.png"));
}

TEST_F(OutputFiles, APipeIsRefusedByEveryWriter) {
  const std::string pipe = *folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto run = [](const std::vector<std::string>& arguments) {
    return RunProgram(FORESIGHTCTL, arguments, {.seconds = 60});
  };
  ExpectLost(FitWithPicture(pipe), "pipe: is a pipe");
  ExpectLost(run({"cloud", *folder_ / "a.foresight", "--out", pipe}), "pipe: is a pipe");
  ExpectLost(run({"emulate", kValveScene, "--seconds", "0.1", "--head-config", pipe}),
             "pipe: is a pipe");
  EXPECT_FALSE(std::filesystem::exists(pipe + ".rig.yaml"));
  ExpectLost(run({"evaluate-fits", "valve", "--count", "1", "--table", pipe}), "pipe: is a pipe");
  ExpectLost(run({"scan", "--scene", kValveScene, "--out", pipe}), "pipe: is not a file");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(OutputFiles, TheCloudNamesItsFrameAndItsScan) {
  const std::string mission = *folder_ / "a.foresight", ply = *folder_ / "cloud.ply";
  const ProgramResult result = RunProgram(FORESIGHTCTL, {"cloud", mission, "--out", ply, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto summary = nlohmann::json::parse(result.output);
  const std::string bytes = ReadFile(ply).value();
  EXPECT_THAT(bytes, HasSubstr("comment unit metre\ncomment frame robot\ncomment scan " +
                               summary["uuid"].get<std::string>() + " 20"));
  EXPECT_THAT(bytes, HasSubstr(fmt::format("element vertex {}\n", summary["points"].get<int>())));
}

}  // namespace
}  // namespace foresight
