#include "core/mission/pose_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/detection/detection_json.h"
#include "core/sensor/rig_id.h"
#include "tests/support/pose_messages.h"

namespace foresight {
namespace {

using testing::HasSubstr;

ValveDetection Valve() {
  ValveDetection valve;
  valve.best.base_from_object = {Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, -0.2, 1.3}};
  valve.best.model.spokes = 4;
  valve.verdict = {VerdictLevel::kConfirmed, 0.98, "", {}};
  valve.covariance = PoseCovariance::Identity() * 1e-6;
  valve.alternatives = {valve.best};
  valve.alternatives[0].model.spokes = 2;
  valve.alternatives[0].log_likelihood = -1.0;  // about as likely
  return valve;
}

/// Mounted 1 m up and turned by 90 deg about z.
SensorRig MountedRig() {
  SensorRig rig = DefaultSensorRig();
  rig.robot_from_base = {
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ())),
      {0.0, 0.0, 1.0}};
  rig.robot_frame_source = RobotFrameSource::kCad;
  return rig;
}

PoseContext Context() {
  PoseContext context;
  context.detection_uuid = "d";
  context.sending = 2;
  context.decision = Decision::kAccepted;
  context.decided_by = "ann";
  context.origin = PoseMessage::Origin::kLive;
  context.scan_uuid = "s";
  context.scan_begin_utc_ns = 5;
  context.age_s = 7.0;
  return context;
}

TEST(PoseMessage, IsInTheRobotsFrameWhereTheRigKnowsHowTheHeadIsMounted) {
  const PoseMessage message = PoseMessageOf(Valve(), 0, MountedRig(), Context()).value();
  EXPECT_EQ(message.frame, PoseMessage::Frame::kRobot);
  // (0.1, -0.2, 1.3) turned by 90 deg about z, and 1 m up; rounding of a few additions.
  EXPECT_TRUE(message.position_m.isApprox(Eigen::Vector3d(0.2, 0.1, 2.3), 1e-12));
  EXPECT_EQ(message.rig_id, RigId(MountedRig()));
}

TEST(PoseMessage, IsInBaseWhereNobodyMeasuredHowTheHeadIsMounted) {
  SensorRig rig = MountedRig();
  rig.robot_frame_source = RobotFrameSource::kUnknown;
  const PoseMessage message = PoseMessageOf(Valve(), 0, rig, Context()).value();
  EXPECT_EQ(message.frame, PoseMessage::Frame::kBase);
  EXPECT_EQ(message.position_m, Eigen::Vector3d(0.1, -0.2, 1.3));
}

TEST(PoseMessage, SaysWhoAcceptedWhatAndOfWhichScan) {
  const PoseMessage message = PoseMessageOf(Valve(), 0, MountedRig(), Context()).value();
  EXPECT_EQ(message.Id(), "d/2");
  EXPECT_EQ(message.decision, Decision::kAccepted);
  EXPECT_EQ(message.decided_by, "ann");
  EXPECT_EQ(message.origin, PoseMessage::Origin::kLive);
  EXPECT_EQ(message.scan_uuid, "s");
  EXPECT_EQ(message.scan_begin_utc_ns, 5);
  EXPECT_EQ(message.age_s, 7.0);
  EXPECT_EQ(message.verdict, VerdictLevel::kConfirmed);
  EXPECT_EQ(message.probability, 0.98);
  EXPECT_TRUE(message.is_winner);
  EXPECT_TRUE(CheckPoseMessage(message));
}

TEST(PoseMessage, OfAnAlternativeHasNeitherProbabilityNorCovarianceForThoseAreTheBestAnswers) {
  const PoseMessage message = PoseMessageOf(Valve(), 1, MountedRig(), Context()).value();
  EXPECT_FALSE(message.is_winner);
  EXPECT_EQ(message.candidate, 1);
  EXPECT_EQ(std::get<ValveParameters>(message.parameters).model.spokes, 2);
  EXPECT_EQ(message.verdict, VerdictLevel::kLikely);
  EXPECT_FALSE(message.probability);
  EXPECT_FALSE(message.covariance);
}

TEST(PoseMessage, ADiscTurnedByAnyAngleIsAsGood) {
  ValveDetection disc = Valve();
  disc.phase_observable = false;
  disc.covariance.row(5).setConstant(std::nan(""));
  disc.covariance.col(5).setConstant(std::nan(""));
  const PoseMessage message = PoseMessageOf(disc, 0, MountedRig(), Context()).value();
  ASSERT_TRUE(message.covariance);
  EXPECT_EQ((*message.covariance)(5, 5), std::numbers::pi * std::numbers::pi / 3.0);
  EXPECT_EQ((*message.covariance)(5, 0), 0.0);
  EXPECT_TRUE(CheckPoseMessage(message));
}

TEST(PoseMessage, ACovarianceThatIsNotKnownIsLeftOut) {
  ValveDetection old = Valve();
  old.covariance.setConstant(std::nan(""));
  EXPECT_FALSE(PoseMessageOf(old, 0, MountedRig(), Context())->covariance);
}

TEST(PoseMessage, EverySurfaceOfATerrainIsAnAnswerOfItsOwn) {
  TerrainDetection terrain;
  terrain.surfaces.resize(2);
  terrain.surfaces[1].kind = TerrainSurface::Kind::kBlock;
  terrain.surfaces[1].size_m = {0.4, 0.2};
  terrain.surfaces[1].verdict = {VerdictLevel::kLikely, 0.8, "", {}};
  terrain.surfaces[1].covariance = PoseCovariance::Identity() * 1e-6;
  const PoseMessage message = PoseMessageOf(terrain, 1, MountedRig(), Context()).value();
  EXPECT_TRUE(message.is_winner);
  EXPECT_EQ(message.verdict, VerdictLevel::kLikely);
  EXPECT_EQ(message.probability, 0.8);
  EXPECT_TRUE(message.covariance);
  const auto& surface = std::get<SurfaceParameters>(message.parameters);
  EXPECT_EQ(surface.kind, TerrainSurface::Kind::kBlock);
  EXPECT_FALSE(surface.step_m) << "nothing is below it";
  EXPECT_TRUE(CheckPoseMessage(message));
}

TEST(PoseMessage, AnAnswerThatIsNotThereIsRefused) {
  const auto none = PoseMessageOf(Valve(), 2, MountedRig(), Context());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(none.error().message, "object d: no answer 2; it has 2, counted from 0");
  EXPECT_FALSE(PoseMessageOf(Valve(), -1, MountedRig(), Context()));
  EXPECT_FALSE(PoseMessageOf(TerrainDetection(), 0, MountedRig(), Context()));
}

TEST(PoseMessage, OfARecordIsAReviewAndAsOldAsItsScan) {
  DetectionRecord record;
  record.uuid = "d";
  record.json = DetectionToJson(Valve(), {});
  record.decision = Decision::kAccepted;
  record.decided_by = "ann";
  ScanSummary scan;
  scan.uuid = "s";
  scan.begin_utc_ns = 1'000'000'000;
  scan.simulated = true;
  const PoseMessage message = PoseMessageOf(record, 0, MountedRig(), scan, 3'500'000'000).value();
  EXPECT_EQ(message.origin, PoseMessage::Origin::kReview);
  EXPECT_TRUE(message.simulated);
  EXPECT_EQ(message.decided_by, "ann");
  EXPECT_EQ(message.age_s, 2.5);
  EXPECT_EQ(message.decision, Decision::kAccepted);
  EXPECT_EQ(PoseMessageOf(record, 1, MountedRig(), scan, 0)->decision, Decision::kOpen)
      << "the decision is about the best answer";
  EXPECT_EQ(PoseMessageOf(record, 0, MountedRig(), scan, 0)->age_s, 0.0) << "a clock that was set";
}

/// What CheckPoseMessage says of the sample with a change.
template <class Change>
std::string MessageFault(const Change& change) {
  PoseMessage message = SamplePose();
  change(message);
  const Status checked = CheckPoseMessage(message);
  return checked ? "" : checked.error().message;
}

TEST(PoseMessageCheck, TakesTheSample) {
  EXPECT_EQ(MessageFault([](PoseMessage&) {}), "");
}

TEST(PoseMessageCheck, NamesTheMemberThatIsNotFinite) {
  const double nan = std::nan("");
  EXPECT_THAT(MessageFault([&](auto& m) { m.position_m.y() = nan; }),
              HasSubstr("'position_m' is nan"));
  EXPECT_THAT(MessageFault([&](auto& m) { m.rotation.x() = nan; }), HasSubstr("'quaternion_wxyz'"));
  EXPECT_THAT(MessageFault([&](auto& m) { (*m.covariance)(2, 1) = nan; }),
              HasSubstr("'covariance'"));
  EXPECT_THAT(MessageFault([&](auto& m) { m.probability = nan; }),
              HasSubstr("'probability' is nan"));
  EXPECT_THAT(MessageFault([&](auto& m) { m.age_s = nan; }), HasSubstr("'age_s' is nan"));
  EXPECT_THAT(
      MessageFault([&](auto& m) { std::get<ValveParameters>(m.parameters).model.dish_m = nan; }),
      HasSubstr("'parameters'"));
  EXPECT_THAT(MessageFault([&](auto& m) {
                DrillParameters drill;
                drill.model.body_tilt_rad.x() = nan;
                m.parameters = drill;
              }),
              HasSubstr("'body_tilt_rad' is nan"));
}

TEST(PoseMessageCheck, NamesTheMemberOutOfItsRange) {
  EXPECT_THAT(MessageFault([](auto& m) { m.position_m.x() = 2e5; }),
              HasSubstr("'position_m' is 200000"));
  EXPECT_THAT(MessageFault([](auto& m) { m.rotation.w() = 0.6; }), HasSubstr("not 1"));
  EXPECT_THAT(MessageFault([](auto& m) { m.probability = 1.01; }),
              HasSubstr("'probability' is 1.01"));
  EXPECT_THAT(MessageFault([](auto& m) { m.age_s = -1.0; }), HasSubstr("'age_s' is -1"));
  EXPECT_THAT(MessageFault([](auto& m) { m.sending = 0; }), HasSubstr("'id' is 0"));
  EXPECT_THAT(MessageFault([](auto& m) { m.detection_uuid = "a/b"; }), HasSubstr("'id' is 'a/b'"));
  EXPECT_THAT(MessageFault([](auto& m) { m.scan_uuid.clear(); }), HasSubstr("'scan'"));
  EXPECT_THAT(MessageFault([](auto& m) { m.rig_id = "A"; }), HasSubstr("'rig'"));
  EXPECT_THAT(MessageFault([](auto& m) { m.decided_by = "two\nlines"; }),
              HasSubstr("'decided_by'"));
  EXPECT_THAT(MessageFault([](auto& m) { m.scan_begin_utc_ns = -1; }), HasSubstr("before 1970"));
}

TEST(PoseMessageCheck, ACovarianceIsSymmetricAndPositiveSemiDefinite) {
  EXPECT_THAT(MessageFault([](auto& m) { (*m.covariance)(0, 1) = 1e-9; }),
              HasSubstr("not symmetric"));
  EXPECT_THAT(
      MessageFault([](auto& m) { (*m.covariance)(0, 1) = (*m.covariance)(1, 0) = 1.001e-6; }),
      HasSubstr("not positive semi-definite"));
  EXPECT_THAT(MessageFault([](auto& m) { (*m.covariance)(3, 3) = -1e-12; }),
              HasSubstr("'covariance'"));
  EXPECT_EQ(MessageFault([](auto& m) {  // on the boundary: one direction is known exactly
              (*m.covariance)(0, 1) = (*m.covariance)(1, 0) = 1e-6;
            }),
            "");
  EXPECT_EQ(MessageFault([](auto& m) { m.covariance->setZero(); }), "");
}

}  // namespace
}  // namespace foresight
