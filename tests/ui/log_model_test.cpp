#include "ui/viewmodels/log_model.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

using Level = Notice::Level;

TEST(LogModel, SomethingLightNeverPushesSomethingWeightyAside) {
  LogModel log;
  log.add({Level::kWarning, "the operator stopped the motor", "release it", {}});
  log.add({Level::kInfo, "wrote 3 points", "", {}});
  ASSERT_NE(log.Top(), nullptr);
  EXPECT_EQ(log.Top()->notice.what.toStdString(), "the operator stopped the motor");
  log.add({Level::kError, "the lidar is gone", "check its cable", {}});
  EXPECT_EQ(log.Top()->notice.what.toStdString(), "the lidar is gone");
}

TEST(LogModel, WhatBecameOfStopStandsBeforeAnyError) {
  LogModel log;
  log.add({Level::kError, "the disk is full", "", kRecordingTopic});
  log.add({Level::kWarning, "the motor was told to stop", "release it", kStopTopic});
  log.add({Level::kError, "the lidar is gone", "", {}});
  EXPECT_EQ(log.Top()->notice.what.toStdString(), "the motor was told to stop");
  log.close(kStopTopic);
  EXPECT_EQ(log.Top()->notice.what.toStdString(), "the lidar is gone");
}

TEST(LogModel, AWarningStaysUntilItIsAcknowledged) {
  LogModel log;
  log.add({Level::kWarning, "a", "", {}});
  EXPECT_EQ(log.Open(), 1);
  log.acknowledgeAll();
  EXPECT_EQ(log.Top(), nullptr);
  EXPECT_EQ(log.Open(), 0);
  EXPECT_EQ(log.Entries().size(), 1u) << "the log forgets nothing";
}

TEST(LogModel, WhatIsOverClosesByItselfAndNothingElse) {
  LogModel log;
  log.add({Level::kWarning, "the scan was aborted", "", kScanTopic});
  log.add({Level::kError, "the disk is full", "", kRecordingTopic});
  log.close(kScanTopic);
  EXPECT_EQ(log.Open(), 1);
  EXPECT_EQ(log.Top()->notice.what.toStdString(), "the disk is full");
}

TEST(LogModel, TheSameMessageIsCountedAndNotListedAgain) {
  LogModel log;
  for (int i = 0; i < 3; ++i) log.add({Level::kError, "no line from the lidar", "", {}});
  ASSERT_EQ(log.Entries().size(), 1u);
  EXPECT_EQ(log.Entries()[0].count, 3);
}

}  // namespace
}  // namespace foresight
