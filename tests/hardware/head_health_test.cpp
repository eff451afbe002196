#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hardware/api/health_watch.h"
#include "hardware/head/scan_recorder.h"
#include "tests/hardware/tiny_head.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

HeadHealth WellHead() {
  HeadHealth health;
  health.lidar.connected = health.camera.connected = health.motor.connected = true;
  health.lidar.line_rate_hz = 40.0;
  health.motor.poll_rate_hz = 240.0;
  return health;
}

TEST(HeadHealth, ADeviceWithoutAConnectionIsMissingAndSaysWhy) {
  HeadHealth health = WellHead();
  health.camera.connected = false;
  health.camera.last_error = "camera 10.0.0.3: does not answer";
  const HeadDiagnosis diagnosis = Diagnose(health, WellHead());
  EXPECT_EQ(diagnosis.camera.condition, DeviceCondition::kMissing);
  EXPECT_EQ(diagnosis.camera.problem, "not connected: camera 10.0.0.3: does not answer");
  EXPECT_EQ(diagnosis.lidar.condition, DeviceCondition::kWell);
  EXPECT_EQ(diagnosis.Worst(), DeviceCondition::kMissing);
}

TEST(HeadHealth, WhatWasLostSinceTheLastLookIsADegradation) {
  HeadHealth health = WellHead();
  health.lidar.lost_lines = 7;
  health.camera.lost = 1;
  health.motor.last_error = 0x8611;
  const HeadDiagnosis diagnosis = Diagnose(health, WellHead());
  EXPECT_EQ(diagnosis.lidar.problem, "lines lost: 7");
  EXPECT_EQ(diagnosis.camera.problem, "images that did not come: 1");
  EXPECT_EQ(diagnosis.motor.problem, "the drive reported error 8611h");
  EXPECT_EQ(diagnosis.Worst(), DeviceCondition::kDegraded);
  EXPECT_EQ(Diagnose(health, health).Worst(), DeviceCondition::kWell) << "it is over";
}

TEST(HeadHealth, AHotCameraAndAVagueClockAreDegradations) {
  HeadHealth health = WellHead();
  health.camera.temperature_c = 82.0;
  health.lidar.sync_round_trip_s = 0.3;
  health.motor.round_trip_median_s = 0.05;
  const HeadDiagnosis diagnosis = Diagnose(health, health);
  EXPECT_EQ(diagnosis.camera.problem, "hot: 82.0 °C");
  EXPECT_EQ(diagnosis.lidar.problem, "its clock is known to 150 ms only");
  EXPECT_EQ(diagnosis.motor.problem, "answers slowly: 50 ms");
}

TEST(HealthWatch, RemembersTroubleForTenSeconds) {
  HealthWatch watch;
  HeadHealth health = WellHead();
  EXPECT_EQ(watch.Update(0.0, health).Worst(), DeviceCondition::kWell);
  health.lidar.lost_lines = 3;
  EXPECT_EQ(watch.Update(1.0, health).Worst(), DeviceCondition::kDegraded);
  EXPECT_EQ(watch.Update(10.5, health).Worst(), DeviceCondition::kDegraded);
  EXPECT_EQ(watch.Update(12.0, health).Worst(), DeviceCondition::kWell);
}

TEST(HeadHealth, TheNumbersReadAsWords) {
  HeadHealth health = WellHead();
  health.lidar.clock_offset_s = 12.3456;
  health.camera.frames = 12;
  health.motor.round_trip_median_s = 31e-6;
  EXPECT_EQ(Describe(health.lidar), "40 lines/s, 0 lost, clock offset 12.346 s");
  EXPECT_EQ(Describe(health.camera), "12 images, 0 lost");
  health.camera.temperature_c = 41.5;
  EXPECT_EQ(Describe(health.camera), "12 images, 0 lost, 41.5 °C");
  EXPECT_EQ(Describe(health.motor), "240 polls/s, round trip 0.03 ms");
}

TEST(HealthWatch, CallsAMotorDegradedWhenMoreThanAFiftiethOfItsPollsIsSlow) {
  HeadHealth before = WellHead(), now = WellHead();
  before.motor.polls = 1000;
  now.motor.polls = 2000;
  now.motor.poll_rate_hz = 20.0;  // idle again: what counts are the polls that there were
  now.motor.slow_polls = 20;
  EXPECT_EQ(Diagnose(now, before).motor.condition, DeviceCondition::kWell);
  now.motor.slow_polls = 21;
  EXPECT_EQ(Diagnose(now, before).motor.problem, "slow polls: 21");
  now.motor.polls = 1040;  // at rest
  now.motor.slow_polls = 10;
  EXPECT_EQ(Diagnose(now, before).motor.condition, DeviceCondition::kWell);
}

TEST(HeadHealth, AsJsonItIsOneLineWithNullForTheUnknown) {
  const std::string text = ToJson(WellHead());
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_TRUE(json["lidar"]["connected"]);
  EXPECT_TRUE(json["camera"]["temperature_c"].is_null());
  EXPECT_EQ(json["motor"]["poll_rate_hz"], 240.0);
}

TEST(CaptureHead, ItsStatusCarriesTheHealthOfItsDevices) {
  TinyHead tiny;
  EXPECT_FALSE(tiny.head->Status().health.motor.connected);
  ASSERT_TRUE(tiny.Home());
  HeadHealth during;
  tiny.watch->action = [&] { during = tiny.head->Status().health; };
  ASSERT_TRUE(tiny.Run(TinyPlan()));
  EXPECT_TRUE(during.lidar.streaming);
  EXPECT_NEAR(during.lidar.line_rate_hz, 40.0, 1e-9);
  EXPECT_GE(during.lidar.lines, 10);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  const HeadHealth after = tiny.head->Status().health;
  EXPECT_FALSE(after.lidar.streaming);
  EXPECT_EQ(after.camera.frames, 1);
  EXPECT_EQ(after.motor.poll_rate_hz, SimulatedMotor::kSampleRate_hz);
}

TEST(ScanRecorder, TheMissionTellsHowTheDevicesDidInAScan) {
  const TemporaryFolder folder;
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  const auto recorder = std::make_shared<ScanRecorder>(mission);
  tiny.sinks = std::make_shared<ScanFanout>(
      std::vector<std::shared_ptr<ScanSink>>{tiny.assembler, recorder, tiny.watch});
  ASSERT_TRUE(tiny.Run(TinyPlan()));
  ASSERT_TRUE(recorder->WaitUntilWritten());
  const auto events = mission->ListEvents().value();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].source, "head");
  EXPECT_EQ(events[0].severity, "info");
  EXPECT_THAT(events[0].text, HasSubstr("scan 1: lidar: 40 lines/s"));
  EXPECT_THAT(events[0].text, HasSubstr("camera: 1 images, 0 lost"));
  EXPECT_EQ(nlohmann::json::parse(events[0].json)["camera"]["frames"], 1);
}

TEST(ScanRecorder, TroubleDuringAScanIsAWarningInTheMission) {
  const TemporaryFolder folder;
  const std::shared_ptr<MissionFile> mission = MissionFile::Create(folder / "m.mission").value();
  ScanRecorder recorder(mission);
  Scan header;
  header.uuid = NewUuid();
  header.rig = TinyRig();
  HeadHealth end = WellHead();
  end.lidar.lost_lines = 4;
  recorder.OnScanStarted(header);
  recorder.OnDeviceHealth(WellHead(), end);
  recorder.OnScanEnded(ScanState::kComplete, "");
  ASSERT_TRUE(recorder.WaitUntilWritten());
  const auto events = mission->ListEvents().value();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].severity, "warning");
  EXPECT_THAT(events[0].text, HasSubstr("(lines lost: 4)"));
}

TEST(HeadHealth, ComesBackFromItsJson) {
  HeadHealth health = WellHead();
  health.lidar.trouble = "37 of 40 lines had a bad check sum";
  health.lidar.lines = std::int64_t{1} << 40;
  health.camera.temperature_c = std::numeric_limits<double>::quiet_NaN();
  health.motor.last_error = 0x8611;
  const HeadHealth back = HeadHealthFromJson(ToJson(health)).value();
  EXPECT_EQ(back.lidar.trouble, health.lidar.trouble);
  EXPECT_EQ(back.lidar.lines, health.lidar.lines);
  EXPECT_TRUE(std::isnan(back.camera.temperature_c));
  EXPECT_EQ(back.motor.last_error, health.motor.last_error);
  EXPECT_EQ(ToJson(back), ToJson(health));
}

TEST(HeadHealth, TextThatIsNoHealthIsRefused) {
  for (const char* text : {"", "{", "[]", "{}", R"({"lidar": 1, "camera": {}, "motor": {}})",
                           R"({"lidar": {"lines": "many"}, "camera": {}, "motor": {}})"})
    EXPECT_FALSE(HeadHealthFromJson(text)) << text;
}

}  // namespace
}  // namespace foresight
