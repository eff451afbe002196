#include "ui/viewmodels/robot_fit_model.h"

#include <gtest/gtest.h>

#include "core/detection/detection_json.h"
#include "core/mission/provenance.h"
#include "core/sensor/rig_id.h"
#include "tests/ui/linked_head.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/send_pose_model.h"

namespace foresight {
namespace {

/// A scan that is still coming: its image is here, its lines are not.
struct RobotFit : testing::Test {
  RobotFit() {
    head->link.health.connected = head->link.health.has_control = true;
    scan.uuid = "0c2f1a3e-0000-4000-8000-000000000001";
    scan.state = ScanState::kRunning;
    Scan early = scan;
    early.lines.clear();
    session.ExpectScan();
    session.SetArriving(std::make_shared<const Scan>(early));
    session.SelectImage(0);
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  void DrawRegion() {
    fit.SetTool(ObjectKind::kTerrain, true);
    fit.setRegionTool(true);
    fit.DrawRegion({Eigen::Vector2d(100, 100), Eigen::Vector2d(200, 180)});
  }
  /// What the head says it found, made from 40 of 80 lines.
  void HeadAnswers() {
    TerrainDetection found;
    found.verdict = {VerdictLevel::kLikely, 0.9, "Made by the head.", {}};
    Provenance provenance;
    provenance.program_version = "1";
    provenance.rig_id = RigId(scan.rig);
    provenance.source = "raw";
    provenance.fit = fit.OptionsFor(ObjectKind::kTerrain);
    provenance.roi = session.Region();
    provenance.part = ScanPart{{{1, 40}}, 40, 80};
    HeadFit made;
    made.detection_json = DetectionToJson(found, scan.rig.robot_from_base);
    made.provenance_json = ProvenanceToJson(provenance);
    made.scan_state = "running";
    made.up_bytes = 1200;
    made.down_bytes = 7500;
    head->link.fit = made;
  }
  bool Fitted() {
    model.fit();
    return WaitFor([&] { return !model.Runner()->Busy(); });
  }

  Scan scan = WallAndValveScan({});
  std::shared_ptr<LinkedHead> head = std::make_shared<LinkedHead>(scan.rig);
  SessionModel session{SessionMode::kSimulation};
  FitViewModel fit{&session};
  DepthViewModel depth{&session};
  RobotFitModel model{head, &session, &fit, &depth};
  std::vector<Notice> notices;
};

TEST_F(RobotFit, SaysWhatIsMissingUntilNothingIs) {
  EXPECT_TRUE(model.WhyNot().contains("Draw a region")) << model.WhyNot().toStdString();
  DrawRegion();
  EXPECT_TRUE(model.WhyNot().isEmpty()) << model.WhyNot().toStdString();
  head->link.health.connected = false;
  EXPECT_TRUE(model.WhyNot().contains("link is lost")) << model.WhyNot().toStdString();
  head->link.health.connected = true;
  head->link.may_operate = false;
  EXPECT_TRUE(model.WhyNot().contains("observer")) << model.WhyNot().toStdString();
  head->link.may_operate = true;
  session.SetScan(std::make_shared<const Scan>(scan));
  EXPECT_TRUE(model.WhyNot().contains("here (F)")) << model.WhyNot().toStdString();
  model.fit();
  EXPECT_TRUE(head->link.Asked().empty()) << "nothing is asked while something is missing";
}

TEST_F(RobotFit, AsksForWhatTheFitHereWouldTake) {
  DrawRegion();
  HeadAnswers();
  ASSERT_TRUE(Fitted());
  const HeadFitOrder& order = head->link.fit_order;
  EXPECT_EQ(order.scan_id, scan.uuid);
  EXPECT_EQ(order.image, HeadFitOrder::Image::kNearest);
  const auto asked = ProvenanceFromJson(order.provenance_json, "the order").value();
  EXPECT_EQ(asked.source, "raw");
  EXPECT_FALSE(asked.depth);
  EXPECT_TRUE(std::holds_alternative<FitTerrainOptions>(*asked.fit));
  EXPECT_EQ(std::get<ImageRoi>(*asked.roi).motor_rad, scan.frames.front().motor_angle_rad);
}

TEST_F(RobotFit, AFitToDepthNamesTheDepthsOptions) {
  fit.SetSource(FitSource::kDepth);
  DrawRegion();
  HeadAnswers();
  ASSERT_TRUE(Fitted());
  const auto asked = ProvenanceFromJson(head->link.fit_order.provenance_json, "the order").value();
  ASSERT_TRUE(asked.depth.has_value());
  EXPECT_EQ(asked.depth->method, depth.Options().method);
  EXPECT_EQ(asked.source, NameOf(NamedSource{FitSource::kDepth, depth.Options().method}));
}

TEST_F(RobotFit, TheAnswerIsListedAsTheRobotsAndCanBeSent) {
  DrawRegion();
  HeadAnswers();
  ASSERT_TRUE(Fitted());
  ASSERT_EQ(session.Objects().size(), 1u);
  const FoundObject& object = session.Objects()[0];
  EXPECT_TRUE(object.by_robot);
  EXPECT_EQ(object.part->lines, 40);
  EXPECT_TRUE(session.IsCurrent(object));
  ASSERT_FALSE(notices.empty());
  EXPECT_TRUE(notices.back().next.contains("1.2 kB")) << notices.back().next.toStdString();
  SendPoseModel send(head, &session);
  EXPECT_TRUE(send.WhyNot().contains("Accept the object first")) << send.WhyNot().toStdString();
}

TEST_F(RobotFit, AFailureAndAnUnreadableAnswerAreSaidAndListNothing) {
  DrawRegion();
  head->link.fit = Fail(ErrorCode::kState, "scan x has no image yet: ask again, or give a box");
  ASSERT_TRUE(Fitted());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_TRUE((notices[0].what + notices[0].next).contains("no image yet"));
  HeadAnswers();
  head->link.fit->detection_json = "{";
  ASSERT_TRUE(Fitted());
  EXPECT_EQ(notices.size(), 2u);
  EXPECT_TRUE(session.Objects().empty());
}

TEST_F(RobotFit, AnAnswerThatComesAfterTheNextScanIsListedWithItsOwn) {
  DrawRegion();
  HeadAnswers();
  model.fit();
  Scan other = scan;
  other.uuid = "0c2f1a3e-0000-4000-8000-000000000002";
  session.SetScan(std::make_shared<const Scan>(other));
  ASSERT_TRUE(WaitFor([&] { return !model.Runner()->Busy(); }));
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(session.Objects()[0].scan_uuid, scan.uuid);
  EXPECT_FALSE(session.IsCurrent(session.Objects()[0]));
}

}  // namespace
}  // namespace foresight
