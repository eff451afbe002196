#include "core/exchange/mission_tables.h"

#include <gmock/gmock.h>

#include "core/detection/detection_json.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(DetectionsTable, HasTheLevelAndThePoseOfTheAnswerThatWasDecidedOn) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.foresight").value();
  Scan scan = SampleScan(1);
  scan.rig.robot_from_base = {};
  DetectionRecord record;
  record.scan_id = Record(*mission, scan);
  record.kind = "valve";
  ValveDetection valve;
  valve.verdict.level = VerdictLevel::kConfirmed;
  valve.alternatives = {valve.best};
  valve.alternatives[0].log_likelihood = valve.best.log_likelihood - 275.0;
  valve.alternatives[0].base_from_object = {Eigen::Quaterniond::Identity(), {4.0, 5.0, 6.0}};
  record.json = DetectionToJson(valve, {});
  const std::int64_t id = mission->AddDetection(record).value();
  EXPECT_THAT(DetectionsCsv(*mission).value(), HasSubstr(",false,1,CONFIRMED,"));
  ASSERT_TRUE(mission->AddDetectionEvent(
      id, {45, "operator", DetectionEvent::Action::kAccepted, "answer 2"}));
  const std::string csv = DetectionsCsv(*mission).value();
  EXPECT_THAT(csv, HasSubstr("deleted,answer,verdict,"));
  EXPECT_THAT(csv, HasSubstr(",false,2,UNSURE,"));
  EXPECT_THAT(csv, HasSubstr(",4,5,6,1,0,0,0\r\n"));
}

}  // namespace
}  // namespace foresight
