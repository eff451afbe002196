#include <gtest/gtest.h>

#include "tests/workstation/hundred_scans.h"

namespace foresight {
namespace {

TEST(HundredScans, OfOneSittingLeaveTheWorkstationUnder800MegabytesAndAreListedInAFifthOfASecond) {
  RecordHundredScans([](Workbench*) { return nullptr; });
}

}  // namespace
}  // namespace foresight
