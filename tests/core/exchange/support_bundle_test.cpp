#include "core/exchange/support_bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/mission/mission_file.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class SupportBundle : public testing::Test {
 protected:
  /// What Python's zipfile reads: the texts by their names; of other entries their sizes.
  nlohmann::json Read() const {
    const ProgramResult read =
        RunProgram("/usr/bin/python3",
                   {"-c",
                    "import json, sys, zipfile\n"
                    "with zipfile.ZipFile(sys.argv[1]) as z:\n"
                    "  assert z.testzip() is None\n"
                    "  print(json.dumps({n: z.read(n).decode('latin-1') for n in z.namelist()}))\n"
                    "  [z.extract(n, sys.argv[2]) for n in z.namelist()]",
                    zip_.string(), (folder_ / "unpacked").string()});
    EXPECT_EQ(read.exit_code, 0) << read.errors;
    return nlohmann::json::parse(read.output);
  }
  std::filesystem::path Text(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  TemporaryFolder folder_;
  const std::filesystem::path zip_ = folder_ / "bundle.zip";
};

TEST_F(SupportBundle, HoldsTheLastScanAsAMissionThatOpens) {
  const auto mission = MissionFile::Create(folder_ / "m.foresight").value();
  Record(*mission, SampleScan(1));
  Record(*mission, SampleScan(2));
  SupportBundleSources sources;
  sources.mission = folder_ / "m.foresight";  // also while it is recorded
  const SupportBundleReport report = WriteSupportBundle(zip_, sources, {}).value();
  EXPECT_THAT(report.left_out, testing::IsEmpty());
  const nlohmann::json files = Read();
  for (const char* name : {"versions.txt", "scans.csv", "detections.csv", "notes.csv", "events.csv",
                           "rig.yaml", "last_scan.foresight", "contents.txt"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_THAT(files["versions.txt"].get<std::string>(), HasSubstr("Foresight "));
  EXPECT_THAT(files["contents.txt"].get<std::string>(), HasSubstr("last_scan.foresight"));
  const auto last = MissionFile::OpenReadOnly(folder_ / "unpacked" / "last_scan.foresight").value();
  ASSERT_EQ(last->ListScans().value().size(), 1u);
  EXPECT_TRUE(SameButForTheRig(last->LoadScan(1).value(), SampleScan(2)));
  EXPECT_EQ(folder_.EntryCount(), 1 + 2 + 1 + 1)
      << "mission with its log, bundle, what was unpacked";
}

TEST_F(SupportBundle, NothingSecretGetsIn) {
  SupportBundleSources sources;
  sources.texts = {
      Text("a/head.yaml", "motor: 10.0.0.3\nPassword: hunter2\nlidar: 10.0.0.2\n"),
      Text("b/head.yaml",
           "-----BEGIN PRIVATE KEY-----\nMIGHAgEAMB\n-----END PRIVATE KEY-----\nend\n"),
      Text("link.key", "-----BEGIN PRIVATE KEY-----\nMIGHAgEAMB\n"), folder_ / "missing.log"};
  const SupportBundleReport report = WriteSupportBundle(zip_, sources, {}).value();
  EXPECT_THAT(report.left_out, Contains(HasSubstr("link.key: keys and certificates stay here")));
  EXPECT_THAT(report.left_out, Contains(HasSubstr("missing.log")));
  const nlohmann::json files = Read();
  EXPECT_EQ(files["texts/head.yaml"], "motor: 10.0.0.3\n(removed)\nlidar: 10.0.0.2\n");
  EXPECT_EQ(files["texts/head-2.yaml"], "(removed)\n(removed)\n(removed)\nend\n");
  EXPECT_THAT(files.dump(), Not(HasSubstr("hunter2")));
  EXPECT_THAT(files.dump(), Not(HasSubstr("MIGHAgEAMB")));
}

TEST_F(SupportBundle, AMissionThatCannotBeReadLeavesNoArchive) {
  SupportBundleSources sources;
  sources.mission = Text("m.foresight", "garbage");
  const auto report = WriteSupportBundle(zip_, sources, {});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kBadData);
  EXPECT_EQ(folder_.EntryCount(), 1) << "the garbage alone";
}

TEST_F(SupportBundle, AMissionWithoutAScanSaysSo) {
  ASSERT_TRUE(MissionFile::Create(folder_ / "m.foresight").value()->Close());
  SupportBundleSources sources;
  sources.mission = folder_ / "m.foresight";
  const SupportBundleReport report = WriteSupportBundle(zip_, sources, {}).value();
  EXPECT_THAT(report.left_out, Contains(HasSubstr("no scan")));
  EXPECT_THAT(Read()["contents.txt"].get<std::string>(), HasSubstr("no scan"));
}

}  // namespace
}  // namespace foresight
