#include "tests/review/mission_for_review.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/mission/mission_timeline.h"
#include "tests/ui/synthetic_scan.h"
#include "ui/viewmodels/mission_objects.h"

namespace foresight {
namespace {

Scan TwoSeconds() {
  Scan scan = WallAndValveScan({.from_rad = -0.1, .to_rad = 0.1, .speed_rad_s = 0.1});
  scan.frames.Edit(0).time_s = scan.lines.front().time_s + 1.0;
  return scan;
}

std::string BytesOfFile(const QString& path) {
  std::ifstream file(path.toStdString(), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

MissionForReview::MissionForReview() : path_(folder_.filePath("m.foresight")) {
  static const Scan kScan = TwoSeconds();  // an image takes a second
  first_ = second_ = kScan;
  first_.uuid = NewUuid();
  second_.uuid = NewUuid();
  second_.start_utc_ns += 60 * kSecond_ns;
  const auto mission = MissionFile::Create(path_.toStdString()).value();
  EXPECT_TRUE(AppendScan(mission.get(), first_, {}));
  EXPECT_TRUE(AppendScan(mission.get(), second_, {}));
  const std::int64_t scan_id = mission->FindScan(first_.uuid).value().value();
  DepthRecord depth;
  depth.scan_id = scan_id;
  depth.utc_ns = FirstEnd() + kSecond_ns;
  EXPECT_TRUE(mission->AddDepth(depth));
  ValveDetection detection;
  detection.best.model.rim_radius_m = 0.123;
  detection.best.base_from_object = SyntheticValvePose();
  detection.origin.roi = ImageRoi::Rectangle(0.0, {10, 10}, {50, 50});
  FoundObject valve;
  valve.detection = detection;
  valve.rig = first_.rig;
  valve.scan_uuid = first_.uuid;
  valve.uuid = kValve;
  DetectionRecord record = RecordOf(valve, "anna");
  record.scan_id = scan_id;
  record.utc_ns = FirstEnd() + 3 * kSecond_ns;
  const std::int64_t id = mission->AddDetection(record).value();
  EXPECT_TRUE(mission->AddDetectionEvent(
      id, {FirstEnd() + 4 * kSecond_ns, "anna", DetectionEvent::Action::kAccepted, ""}));
  mission->AddEvent({0, FirstBegin(), kLinkEventSource, "info", kLinkUpText, ""}).value();
  mission
      ->AddEvent({0, FirstEnd() + 10 * kSecond_ns, kLinkEventSource, "warning", kLinkLostText, ""})
      .value();
  mission->AddEvent({0, FirstEnd() + 20 * kSecond_ns, "head", "warning", "the motor is hot", ""})
      .value();
  EXPECT_TRUE(mission->Close());
}

std::int64_t MissionForReview::FirstBegin() const {
  return BeginUtc_ns(first_);
}

std::int64_t MissionForReview::FirstEnd() const {
  return first_.start_utc_ns + static_cast<std::int64_t>(1e9 * first_.lines.back().time_s);
}

std::int64_t MissionForReview::SecondBegin() const {
  return BeginUtc_ns(second_);
}

QString MissionForReview::MakeAnother(const QString& name) const {
  const QString path = folder_.filePath(name);
  const auto mission = MissionFile::Create(path.toStdString()).value();
  EXPECT_TRUE(AppendScan(mission.get(), second_, {}));
  EXPECT_TRUE(mission->Close());
  return path;
}

std::string MissionForReview::Bytes() const {
  return BytesOfFile(path_);
}

}  // namespace foresight
