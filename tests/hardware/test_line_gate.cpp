#include <gtest/gtest.h>

#include "core/geometry/angles.h"
#include "hardware/head/line_gate.h"

namespace foresight {
namespace {

/// A motor at 10 deg/s that passes 0 at time 0, known until `until_s`.
MotorTrack Track(double until_s, double sign = 1.0) {
  MotorTrack track;
  for (int i = -480; i / 240.0 <= until_s; ++i)
    track.Add({i / 240.0, sign * RadiansFromDegrees(10.0 * i / 240.0)});
  return track;
}

LidarLine Line(std::int64_t seq) {
  LidarLine line;
  line.seq = seq;
  line.time_s = 0.025 * static_cast<double>(seq);
  return line;
}

std::vector<std::int64_t> Taken(LineGate& gate, const MotorTrack& track) {
  std::vector<std::int64_t> numbers;
  for (const LidarLine& line : gate.Take(track)) numbers.push_back(line.seq);
  return numbers;
}

// A line spans 0.1875 deg of the 0.25 deg to the next one.
TEST(LineGate, KeepsTheScopeAndOneLineOnEachSide) {
  LineGate gate(LidarModel(), RadiansFromDegrees(-0.6), RadiansFromDegrees(0.6));
  for (int seq = -10; seq <= 10; ++seq) gate.Push(Line(seq));
  EXPECT_EQ(Taken(gate, Track(1.0)), (std::vector<std::int64_t>{-3, -2, -1, 0, 1, 2}));
  EXPECT_TRUE(gate.Passed());
}

TEST(LineGate, KeepsTheSameOnTheWayDown) {
  LineGate gate(LidarModel(), RadiansFromDegrees(0.6), RadiansFromDegrees(-0.6));
  for (int seq = -10; seq <= 10; ++seq) gate.Push(Line(seq));
  EXPECT_EQ(Taken(gate, Track(1.0, -1.0)), (std::vector<std::int64_t>{-3, -2, -1, 0, 1, 2}));
}

TEST(LineGate, HoldsALineUntilTheMotorIsKnownBeyondIt) {
  LineGate gate(LidarModel(), RadiansFromDegrees(-0.6), RadiansFromDegrees(5.0));
  gate.Push(Line(0));
  EXPECT_TRUE(Taken(gate, Track(0.02)).empty());
  EXPECT_EQ(Taken(gate, Track(0.05)), (std::vector<std::int64_t>{0}));
}

TEST(LineGate, AScopeNarrowerThanALineStillGivesItsLines) {
  LineGate gate(LidarModel(), RadiansFromDegrees(0.05), RadiansFromDegrees(0.15));
  for (int seq = -3; seq <= 3; ++seq) gate.Push(Line(seq));
  // Line 0 spans the whole scope.
  EXPECT_EQ(Taken(gate, Track(1.0)), (std::vector<std::int64_t>{-1, 0}));
}

TEST(LineGate, DropsLinesThatTheTrackDoesNotKnow) {
  LineGate gate(LidarModel(), RadiansFromDegrees(-90.0), RadiansFromDegrees(90.0));
  gate.Push(Line(-1000));
  EXPECT_TRUE(Taken(gate, Track(1.0)).empty());
}

/// Samples with a hole between two times.
MotorTrack TrackWithHole(double from_s, double to_s) {
  const MotorTrack whole = Track(1.0);
  MotorTrack track;
  for (const MotorSample& sample : whole.samples())
    if (sample.time_s < from_s || sample.time_s > to_s) track.Add(sample);
  return track;
}

TEST(LineGate, CountsTheLinesOfTheScopeThatFellIntoAHoleOfTheTrack) {
  LineGate gate(LidarModel(), RadiansFromDegrees(-2.0), RadiansFromDegrees(6.0));
  for (int seq = -10; seq <= 30; ++seq) gate.Push(Line(seq));
  const auto taken = Taken(gate, TrackWithHole(0.1, 0.4));
  EXPECT_TRUE(gate.Passed());
  EXPECT_GT(gate.Unplaced(), 5);
  EXPECT_EQ(static_cast<std::int64_t>(taken.size()) + gate.Unplaced(),
            taken.back() - taken.front() + 1);
}

TEST(LineGate, AHoleBeforeTheScopeCostsItNothing) {
  LineGate gate(LidarModel(), RadiansFromDegrees(5.0), RadiansFromDegrees(6.0));
  for (int seq = -10; seq <= 30; ++seq) gate.Push(Line(seq));
  EXPECT_FALSE(Taken(gate, TrackWithHole(0.1, 0.4)).empty());
  EXPECT_EQ(gate.Unplaced(), 0);
}

}  // namespace
}  // namespace foresight
