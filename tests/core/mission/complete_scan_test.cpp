#include "core/mission/complete_scan.h"

#include <gmock/gmock.h>

#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class CompleteScanTest : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const std::unique_ptr<MissionFile> mission = MissionFile::Create(folder / "m.foresight").value();
};

TEST_F(CompleteScanTest, PutsInAScanThatIsNotThere) {
  const std::int64_t id = CompleteScan(*mission, SampleScan(1)).value();
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), SampleScan(1)));
}

TEST_F(CompleteScanTest, CompletesWhatWasCutShort) {
  const Scan scan = SampleScan(1);
  const std::int64_t begun = mission->BeginScan(scan).value();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(mission->AppendLine(begun, scan.lines[i]));
  ASSERT_TRUE(mission->AppendMotorSamples(begun, scan.track.samples().first(40)));
  ASSERT_TRUE(mission->AppendFrame(begun, scan.frames[0]));
  ASSERT_TRUE(mission->EndScan(begun, ScanState::kInterrupted, "the link was lost"));
  EXPECT_EQ(CompleteScan(*mission, scan).value(), begun);
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(begun).value(), scan));
  EXPECT_EQ(mission->ListScans()->size(), 1u);
}

TEST_F(CompleteScanTest, LeavesAWholeScanAsItIs) {
  const std::int64_t id = CompleteScan(*mission, SampleScan(1)).value();
  EXPECT_EQ(CompleteScan(*mission, SampleScan(1)).value(), id);
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), SampleScan(1)));
}

TEST_F(CompleteScanTest, RefusesAnotherScanOfTheSameName) {
  const std::int64_t id = CompleteScan(*mission, SampleScan(1)).value();
  Scan other = SampleScan(2);
  other.uuid = SampleScan(1).uuid;
  EXPECT_THAT(CompleteScan(*mission, other).error().message, HasSubstr("with other lines"));
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(id).value(), SampleScan(1)));
}

}  // namespace
}  // namespace foresight
