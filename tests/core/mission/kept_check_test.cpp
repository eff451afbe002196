#include "core/mission/kept_check.h"

#include <gmock/gmock.h>

#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A mission and its review; nothing in them but checks.
struct KeptCheckTest : testing::Test {
  TemporaryFolder folder;
  std::unique_ptr<MissionFile> mission = MissionFile::Create(folder / "m.foresight").value();
  std::unique_ptr<MissionFile> review = MissionFile::OpenReviewOf(folder / "m.foresight").value();
  Scan scan = SampleScan(1);

  KeptCheck Check(CheckLight light, const std::string& advice, std::int64_t utc_ns) const {
    ScanCheck check;
    check.light = light;
    check.advice = advice;
    check.points = {{"depth", light, advice}};
    check.cannot_see = {"the lens"};
    KeptCheck kept = NewKeptCheck(scan, check, {});
    kept.utc_ns = utc_ns;
    return kept;
  }
};

TEST_F(KeptCheckTest, WhatALampShowsComesBackFromTheFile) {
  const KeptCheck kept = Check(CheckLight::kAmber, "check the calibration", 5);
  ASSERT_TRUE(AddScanCheck(*mission, kept));
  const auto checks = NewestScanChecks(*mission, nullptr);
  ASSERT_TRUE(checks && checks->size() == 1);
  const KeptCheck& last = checks->front();
  EXPECT_EQ(last.scan_uuid, scan.uuid);
  EXPECT_EQ(last.light, CheckLight::kAmber);
  EXPECT_EQ(last.advice, "check the calibration");
  EXPECT_EQ(last.points.at(0).light, CheckLight::kAmber);
  EXPECT_EQ(last.cannot_see.at(0), "the lens");
  EXPECT_EQ(last.answer_json, kept.answer_json);
}

TEST_F(KeptCheckTest, TheNewestCountsWhereverItIsKept) {
  ASSERT_TRUE(AddScanCheck(*mission, Check(CheckLight::kGood, "live", 10)));
  ASSERT_TRUE(AddScanCheck(*review, Check(CheckLight::kRed, "later", 30)));
  ASSERT_TRUE(AddScanCheck(*review, Check(CheckLight::kAmber, "between", 20)));
  EXPECT_EQ(NewestScanChecks(*mission, review.get()).value().at(0).advice, "later");
  EXPECT_EQ(NewestScanChecks(*mission, nullptr).value().at(0).advice, "live");
  scan.uuid = "another scan";
  ASSERT_TRUE(AddScanCheck(*review, Check(CheckLight::kGood, "of another scan", 5)));
  EXPECT_EQ(NewestScanChecks(*mission, review.get()).value().size(), 2u);
}

TEST_F(KeptCheckTest, ABadRecordIsNamedWithItsEvent) {
  ASSERT_TRUE(mission->AddEvent({0, 1, "self-check", "info", "x", "{\"format\": 1}"}));
  const auto checks = ListScanChecks(*mission);
  ASSERT_FALSE(checks);
  EXPECT_EQ(checks.error().code, ErrorCode::kBadData);
  EXPECT_THAT(checks.error().message, HasSubstr("event 1: self-check: "));
}

}  // namespace
}  // namespace foresight
