#include "core/registration/growing_registration.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "tests/support/swept_plane.h"

namespace foresight {
namespace {

const Plane kGrowingWall{Eigen::Vector3d::UnitZ(), 2.0};  // two metres ahead, in base

/// In every bit: NaN equals NaN.
template <class T>
bool SameBits(const SharedArray<T>& a, const SharedArray<T>& b) {
  return a.size() == b.size() &&
         std::memcmp(static_cast<const void*>(a.data()), static_cast<const void*>(b.data()),
                     a.size() * sizeof(T)) == 0;
}

void ExpectSame(const RegisteredScan& grown, const RegisteredScan& whole) {
  EXPECT_EQ(grown.lines, whole.lines);
  EXPECT_EQ(grown.beams, whole.beams);
  EXPECT_TRUE(SameBits(grown.points, whole.points));
  EXPECT_TRUE(SameBits(grown.range_m, whole.range_m));
  EXPECT_TRUE(SameBits(grown.intensity, whole.intensity));
  EXPECT_TRUE(SameBits(grown.origins, whole.origins));
}

/// The scan when its `lines`-th line had come and the track was known for `ahead_s` beyond it.
Scan PartOf(const Scan& scan, std::size_t lines, double ahead_s) {
  Scan part = scan;
  part.state = ScanState::kComplete;
  part.lines.Truncate(lines);
  part.track = {};
  for (const MotorSample& sample : scan.track.samples())
    if (sample.time_s <= scan.lines[lines - 1].time_s + ahead_s) part.track.Add(sample);
  return part;
}

class GrowingScan : public testing::TestWithParam<double> {};

TEST_P(GrowingScan, HasThePointsOfTheWholeInEveryBit) {
  Scan scan = SweptPlane(kGrowingWall, -5, 5, 20);
  scan.uuid = "a";
  GrowingRegistration growing;
  for (const std::size_t lines : {1u, 2u, 3u, 7u, 8u, 8u, 15u, 20u}) {
    const Scan part = PartOf(scan, lines, GetParam());
    const auto grown = growing.Update(part, {});
    const auto whole = RegisterScan(part, {});
    ASSERT_EQ(grown.has_value(), whole.has_value()) << lines;
    if (whole) ExpectSame(*grown, *whole);
  }
  const auto grown = growing.Update(scan, {});
  ASSERT_TRUE(grown);
  ExpectSame(*grown, *RegisterScan(scan, {}));
}

// As the head hands lines on; so that the last beams have another angle later; and none yet.
INSTANTIATE_TEST_SUITE_P(Tracks, GrowingScan, testing::Values(0.05, 0.025, 0.0));

TEST(GrowingRegistration, PlacesOnlyWhatIsNew) {
  Scan scan = SweptPlane(kGrowingWall, -5, 5, 20);
  scan.uuid = "a";
  GrowingRegistration growing;
  ASSERT_TRUE(growing.Update(PartOf(scan, 10, 0.1), {}));
  EXPECT_EQ(growing.lines_placed(), 10);
  ASSERT_TRUE(growing.Update(PartOf(scan, 13, 0.1), {}));
  EXPECT_EQ(growing.lines_placed(), 3);
  ASSERT_TRUE(growing.Update(PartOf(scan, 13, 0.1), {}));
  EXPECT_EQ(growing.lines_placed(), 0);
}

TEST(GrowingRegistration, EarlierResultsStayAsTheyWere) {
  Scan scan = SweptPlane(kGrowingWall, -5, 5, 20);
  scan.uuid = "a";
  GrowingRegistration growing;
  const Scan part = PartOf(scan, 10, 0.1);
  const RegisteredScan before = growing.Update(part, {}).value();
  ASSERT_TRUE(growing.Update(scan, {}));
  ExpectSame(before, RegisterScan(part, {}).value());
}

TEST(GrowingRegistration, WhileTheScanRunsALineWaitsUntilItsAnglesAreKnown) {
  Scan scan = SweptPlane(kGrowingWall, -5, 5, 20);
  scan.uuid = "a";
  GrowingRegistration growing;
  for (const std::size_t lines : {5u, 12u, 20u}) {
    Scan part = PartOf(scan, lines, 0.0);
    part.state = ScanState::kRunning;
    const RegisteredScan grown = growing.Update(part, {}).value();
    ASSERT_LT(grown.lines, static_cast<int>(lines));
    ASSERT_GE(grown.lines, static_cast<int>(lines) - 3);
    Scan placed = PartOf(scan, lines, 1.0);
    placed.lines.Truncate(static_cast<std::size_t>(grown.lines));
    ExpectSame(grown, RegisterScan(placed, {}).value());
  }
  scan.state = ScanState::kComplete;
  ExpectSame(growing.Update(scan, {}).value(), RegisterScan(scan, {}).value());
}

TEST(GrowingRegistration, PointsAreNotCopiedAtEachUpdate) {
  Scan scan = SweptPlane(kGrowingWall, -5, 5, 20);
  scan.uuid = "a";
  GrowingRegistration growing;
  std::vector<RegisteredScan> kept;
  std::set<const void*> places;
  for (std::size_t lines = 3; lines <= scan.lines.size(); ++lines) {
    Scan part = PartOf(scan, lines, 0.01);
    part.state = ScanState::kRunning;
    kept.push_back(growing.Update(part, {}).value());
    places.insert(kept.back().points.data());
  }
  ASSERT_GT(kept.size(), 12u);
  EXPECT_LE(places.size(), 6u) << "room grows by doubling";
}

TEST(GrowingRegistration, AnotherScanBeginsAnew) {
  Scan one = SweptPlane(kGrowingWall, -5, 5, 20);
  Scan other = SweptPlane({Eigen::Vector3d::UnitZ(), 3.0}, -5, 5, 20);
  one.uuid = "a";
  other.uuid = "b";
  GrowingRegistration growing;
  ASSERT_TRUE(growing.Update(one, {}));
  ExpectSame(growing.Update(other, {}).value(), RegisterScan(other, {}).value());
}

TEST(GrowingRegistration, RefusesLinesOfAnotherLidarAndGoesOnWithGoodOnes) {
  const Scan good = SweptPlane(kGrowingWall, -5, 5, 20);
  Scan bad = good;
  bad.lines.Edit(3).range_mm.pop_back();
  GrowingRegistration growing;
  EXPECT_EQ(growing.Update(bad, {}).error().message, RegisterScan(bad, {}).error().message);
  ExpectSame(growing.Update(good, {}).value(), RegisterScan(good, {}).value());
}

}  // namespace
}  // namespace foresight
