#include "hardware/link/server/fit_desk.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/detection/detection_json.h"
#include "core/io/json_reader.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/protocol/messages.h"
#include "tests/hardware/link/head_bench.h"
#include "tests/support/growing_scan.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

constexpr char kScan[] = "a-scan";

bool Never() {
  return false;
}

class FitDeskTest : public ::testing::Test {
 protected:
  static const Scan& Room() {
    static const Scan scan = [] {
      Scan made = samples::SweepOverRoom(samples::RigWithImage(322, 241), 0.5);
      made.uuid = kScan;
      return made;
    }();
    return scan;
  }
  FitDeskTest() {
    EXPECT_TRUE(head.Home());
    EXPECT_TRUE(head.StartScan(ScanPlan(), shelf->Begin(kScan, {}).value()));
  }
  void Play() {
    head.Play(Room());
    ASSERT_TRUE(
        Eventually([&] { return shelf->Find(kScan).value().state != ScanState::kRunning; }));
  }
  static Provenance Wanted() {
    Provenance provenance;
    provenance.source = "raw";
    provenance.fit = FitOptionsFor(ObjectKind::kTerrain, Room().rig.robot_from_base);
    provenance.roi = BoxRoi{{Eigen::Quaterniond::Identity(), {0.0, 1.0, 3.0}}, {3.0, 1.0, 3.0}};
    return provenance;
  }
  static link::FitRequest Request(const std::string& id, const Provenance& provenance = Wanted()) {
    link::FitRequest request;
    request.set_command_id(id);
    request.set_scan_id(kScan);
    request.set_provenance_json(ProvenanceToJson(provenance));
    return request;
  }

  const TemporaryFolder folder;
  const std::unique_ptr<ScanShelf> shelf = ScanShelf::Open({folder / "scans", 0.9}).value();
  FakeHead head;
  FitDesk desk{*shelf};
};

TEST_F(FitDeskTest, TheNumbersAreThoseOfAFitHere) {
  Play();
  const link::FitReply reply = desk.Fit(Request("1"), "anna", Never).value();
  ASSERT_FALSE(reply.has_failure()) << reply.failure().message();
  ScanWorkbench bench;
  ASSERT_TRUE(bench.Take(shelf->Snapshot(kScan).value(), {}));
  Provenance provenance = Wanted();
  provenance.rig_id = RigId(Room().rig);
  const Detection here = bench.Fit(provenance, {}).value();
  auto theirs = ParseJson(reply.detection_json());
  auto ours = ParseJson(DetectionToJson(here, Room().rig.robot_from_base));
  theirs.erase("seconds");
  ours.erase("seconds");
  EXPECT_EQ(theirs, ours);
  EXPECT_EQ(reply.scan_state(), "complete");
  EXPECT_FALSE(ProvenanceFromJson(reply.provenance_json(), "").value().part);
}

TEST_F(FitDeskTest, AScanThatGrowsIsFittedInWhatIsThere) {
  const auto sink = head.Sink();
  Scan header = Room();
  header.lines.clear();
  header.frames.clear();
  header.track = {};
  header.state = ScanState::kRunning;
  sink->OnScanStarted(header);
  sink->OnMotorSamples(Room().track.samples());
  const std::size_t half = Room().lines.size() / 2;
  for (std::size_t i = 0; i < half; ++i) sink->OnLine(Room().lines[i]);
  ASSERT_TRUE(Eventually([&] {
    return shelf->Find(kScan).value().lines == static_cast<int>(half) &&
           shelf->Snapshot(kScan).value()->lines.size() == half;
  }));
  const link::FitReply reply = desk.Fit(Request("1"), "anna", Never).value();
  const auto made = ProvenanceFromJson(reply.provenance_json(), "").value();
  ASSERT_TRUE(made.part);
  EXPECT_EQ(made.part->lines, static_cast<int>(half));
  EXPECT_EQ(made.part->of_lines, shelf->Find(kScan).value().expected_lines);
  EXPECT_GT(made.part->of_lines, made.part->lines);
  EXPECT_EQ(reply.scan_state(), "running");
  sink->OnScanEnded(ScanState::kComplete, "");
}

TEST_F(FitDeskTest, ARepeatIsAnsweredWithTheFirstAnswer) {
  Play();
  const link::FitReply first = desk.Fit(Request("1"), "anna", Never).value();
  const link::FitReply again = desk.Fit(Request("1"), "anna", Never).value();
  EXPECT_FALSE(first.repeated());
  EXPECT_TRUE(again.repeated());
  EXPECT_EQ(again.detection_json(), first.detection_json()) << "with the first one's seconds too";
}

TEST_F(FitDeskTest, AFitOutlivesTheCallThatAskedForIt) {
  Play();
  const auto left = desk.Fit(Request("1"), "anna", [] { return true; });
  ASSERT_FALSE(left);
  EXPECT_EQ(left.error().code, ErrorCode::kCancelled);
  EXPECT_FALSE(desk.Fit(Request("1"), "anna", Never).value().has_failure());
}

TEST_F(FitDeskTest, SomebodyElsesFitIsWaitedFor) {
  Play();
  ASSERT_FALSE(desk.Fit(Request("1"), "anna", [] { return true; }));
  const auto other = desk.Fit(Request("2"), "boris", Never);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kState);
  EXPECT_THAT(other.error().message, HasSubstr("anna"));
  EXPECT_TRUE(desk.Fit(Request("1"), "anna", Never));
  EXPECT_TRUE(desk.Fit(Request("2"), "boris", Never));
}

TEST_F(FitDeskTest, ACallersNextFitTakesThePlaceOfTheLastOne) {
  Play();
  ASSERT_FALSE(desk.Fit(Request("1"), "anna", [] { return true; }));
  EXPECT_FALSE(desk.Fit(Request("2"), "anna", Never).value().has_failure());
  const link::FitReply first = desk.Fit(Request("1"), "anna", Never).value();
  ASSERT_TRUE(first.has_failure());
  EXPECT_EQ(first.failure().error(), link::CANCELLED);
}

TEST_F(FitDeskTest, AFitThatIsNotWantedAnyMoreEnds) {
  Play();
  ASSERT_FALSE(desk.Fit(Request("1"), "anna", [] { return true; }));
  link::FitRequest cancel = Request("1");
  cancel.set_cancel(true);
  const link::FitReply reply = desk.Fit(cancel, "anna", Never).value();
  ASSERT_TRUE(reply.has_failure());
  EXPECT_EQ(reply.failure().error(), link::CANCELLED);
}

TEST_F(FitDeskTest, WhatFindsNothingIsAnAnswer) {
  Play();
  Provenance nowhere = Wanted();
  nowhere.roi = BoxRoi{{Eigen::Quaterniond::Identity(), {0.0, 0.0, 90.0}}, {1.0, 1.0, 1.0}};
  const link::FitReply reply = desk.Fit(Request("1", nowhere), "anna", Never).value();
  ASSERT_TRUE(reply.has_failure());
  EXPECT_EQ(FromMessage(reply.failure()).error().code, ErrorCode::kTooFewPoints);
}

TEST_F(FitDeskTest, AnotherRigIsRefused) {
  Play();
  Provenance other = Wanted();
  other.rig_id = "0123";
  const link::FitReply reply = desk.Fit(Request("1", other), "anna", Never).value();
  EXPECT_THAT(reply.failure().message(), HasSubstr("0123"));
}

TEST_F(FitDeskTest, WhatIsNoOrderIsRefused) {
  Play();
  const auto refused = [&](const link::FitRequest& request) {
    const auto reply = desk.Fit(request, "anna", Never);
    return !reply && reply.error().code == ErrorCode::kInvalidInput;
  };
  EXPECT_TRUE(refused(Request("")));
  EXPECT_TRUE(refused(Request(std::string(100, 'x'))));
  EXPECT_TRUE(refused(Request("1", Provenance())));
  link::FitRequest request = Request("1");
  request.set_scan_id("none");
  EXPECT_TRUE(refused(request));
  for (const char* json : {"", "{", "[]", "{\"fit_options\": 3}"}) {
    request = Request("1");
    request.set_provenance_json(json);
    EXPECT_TRUE(refused(request)) << json;
  }
}

TEST_F(FitDeskTest, TheImageIsTheOneNearestToTheRegion) {
  Play();
  Provenance region = Wanted();
  region.roi = ImageRoi::Rectangle(0.3, {100.0, 150.0}, {220.0, 230.0});
  region.source = "foresight";
  region.depth = DepthOptions();
  link::FitRequest request = Request("1", region);
  request.set_image(link::NEAREST_TO_THE_REGION);
  const link::FitReply reply = desk.Fit(request, "anna", Never).value();
  ASSERT_FALSE(reply.has_failure()) << reply.failure().message();
  const Provenance made = ProvenanceFromJson(reply.provenance_json(), "").value();
  EXPECT_EQ(made.image_position, 0);
  EXPECT_EQ(std::get<ImageRoi>(*made.roi).motor_rad, Room().frames[0].motor_angle_rad);
}

}  // namespace
}  // namespace foresight
