// What the list of a mission's scans says of each.
#include "ui/panels/scan_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ScanListOnScreen, AScanThatRunsIsOfNowAndHasItsTimeWhenItHasEnded) {
  ScanSummary scan;
  // The head's clock began ten minutes before the scan, which has no line yet.
  scan.start_utc_ns = scan.begin_utc_ns = 1'700'000'000'000'000'000;
  ScanList list;
  list.Show({scan}, -1);
  const std::string running = list.TextOf(0).toStdString();
  EXPECT_THAT(running, StartsWith("Now\n"));
  EXPECT_THAT(running, Not(HasSubstr("2023")));
  EXPECT_THAT(running, HasSubstr("running"));
  scan.state = ScanState::kComplete;
  scan.lines = 241;
  scan.begin_utc_ns += 600'000'000'000;
  list.Show({scan}, -1);
  EXPECT_THAT(list.TextOf(0).toStdString(), StartsWith("2023-11-14"));
  EXPECT_THAT(list.TextOf(0).toStdString(), HasSubstr("241 lines"));
}

}  // namespace
}  // namespace foresight
