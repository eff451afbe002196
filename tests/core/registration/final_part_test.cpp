#include "core/registration/final_part.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/registration/register_scan.h"
#include "tests/support/swept_plane.h"

namespace foresight {
namespace {

const Plane kWall{Eigen::Vector3d::UnitZ(), 2.0};  // two metres ahead, in base

/// Every second line of a running sweep, and the track as far as `until_s`.
Scan Running(const Scan& whole, double until_s) {
  Scan scan = whole;
  scan.state = ScanState::kRunning;
  scan.lines.clear();
  for (std::size_t i = 0; i < whole.lines.size(); i += 2)
    scan.lines.push_back(whole.lines.Share(i));
  scan.track = {};
  for (const MotorSample& sample : whole.track.samples())
    if (sample.time_s <= until_s) scan.track.Add(sample);
  return scan;
}

TEST(FinalPart, IsWhatTheWholeTrackDoesNotChange) {
  const Scan whole = SweptPlane(kWall, -5, 5, 20);
  const double middle_s = whole.lines[10].time_s;
  const Scan part = FinalPart(Running(whole, middle_s));
  ASSERT_GT(part.lines.size(), 0u);
  ASSERT_LT(part.lines.size(), 6u) << "the lines beyond the track's end wait";
  Scan with_whole_track = part;
  with_whole_track.track = whole.track;
  const auto now = RegisterScan(part, {}), later = RegisterScan(with_whole_track, {});
  ASSERT_TRUE(now && later);
  EXPECT_EQ(std::memcmp(static_cast<const void*>(now->points.data()),
                        static_cast<const void*>(later->points.data()),
                        now->points.size() * sizeof(Eigen::Vector3f)),
            0);
}

TEST(FinalPart, OfAScanThatHasEndedIsAllOfIt) {
  Scan scan = Running(SweptPlane(kWall, -5, 5, 20), 0.0);
  EXPECT_EQ(FinalPart(scan).lines.size(), 0u);
  scan.state = ScanState::kAborted;
  EXPECT_EQ(FinalPart(scan).lines.size(), 10u);
}

}  // namespace
}  // namespace foresight
