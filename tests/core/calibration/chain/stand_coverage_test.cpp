#include "core/calibration/stand_coverage.h"

#include <gmock/gmock.h>

#include "core/evaluation/simulate_calibration.h"

namespace foresight {
namespace {

using testing::HasSubstr;

SimulatedCalibration Simulated(int poses) {
  CalibrationSimulation options;
  options.seed = 3;
  options.poses = poses;
  options.intrinsic_views = 0;
  options.scans_per_stop = 1;  // a stop without image and lines is none
  options.sweeps = 0;
  auto made = SimulateCalibration(options);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

TEST(StandCoverage, OfNothingAsksForTheStand) {
  EXPECT_THAT(NextPlace(StandCoverage()), HasSubstr("0.8 to 1.5 m away"));
}

TEST(StandCoverage, OfOnePlaceAsksForTheStopsThatDoNotSeeIt) {
  CalibrationSession session = Simulated(6).session;
  session.poses.resize(1);
  const StandCoverage coverage = MeasureStand(session, session.prior);
  EXPECT_EQ(coverage.poses, 1);
  ASSERT_FALSE(coverage.graph.Complete());
  EXPECT_THAT(NextPlace(coverage), testing::AnyOf(HasSubstr("higher"), HasSubstr("lower")));
  EXPECT_THAT(NextPlace(coverage), HasSubstr("hinge"));
}

TEST(StandCoverage, TellsTheHingesTurnAlsoByARoughRig) {
  // The simulated hinges take turns: upright, and 45 deg on in each pose.
  const SimulatedCalibration made = Simulated(8);
  const StandCoverage rough = MeasureStand(made.session, made.session.prior);
  const StandCoverage exact = MeasureStand(made.session, made.truth);
  EXPECT_EQ(exact.poses, 8);
  EXPECT_EQ(rough.hinges, exact.hinges);
  for (const int count : exact.hinges) EXPECT_EQ(count, 2);
}

TEST(StandCoverage, AsksForAHingeThatWasNeverTurnedThatWay) {
  SimulatedCalibration made = Simulated(8);
  const StandCoverage all = MeasureStand(made.session, made.truth);
  StandCoverage without = all;
  without.hinges[StandCoverage::kLevel] = 0;
  EXPECT_THAT(NextPlace(without), HasSubstr("hinge level"));
}

TEST(StandCoverage, AsksForASweepWhenThePlacesAreThere) {
  StandCoverage coverage;
  coverage.poses = 6;
  coverage.hinges = {2, 1, 2, 1};
  coverage.left = coverage.right = 3;
  EXPECT_THAT(NextPlace(coverage), HasSubstr("sweep up and down"));
  coverage.sweeps = 1;
  EXPECT_EQ(NextPlace(coverage), "");
  coverage.poses = 4;
  EXPECT_THAT(NextPlace(coverage), HasSubstr("4 of 6"));
}

}  // namespace
}  // namespace foresight
