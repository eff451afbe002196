// An object found again in each half of a scan's lines.
#include "core/selfcheck/half_fits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foresight {
namespace {

/// Each point tells its line and beam; nothing is there to be fitted.
RegisteredScan Numbered(int lines, int beams) {
  RegisteredScan scan;
  scan.lines = lines;
  scan.beams = beams;
  for (int line = 0; line < lines; ++line) {
    scan.origins.push_back(Eigen::Vector3f(0.0f, 0.0f, static_cast<float>(line)));
    for (int beam = 0; beam < beams; ++beam) {
      scan.points.push_back(
          Eigen::Vector3f(static_cast<float>(line), static_cast<float>(beam), 5.0f));
      scan.range_m.push_back(static_cast<float>(10 * line + beam));
      scan.intensity.push_back(1.0f);
    }
  }
  return scan;
}

TEST(HalfOf, HoldsEveryOtherLine) {
  const RegisteredScan whole = Numbered(5, 3);
  const RegisteredScan even = HalfOf(whole, false), odd = HalfOf(whole, true);
  EXPECT_EQ(even.lines, 3);
  EXPECT_EQ(odd.lines, 2);
  EXPECT_EQ(even.beams, 3);
  EXPECT_EQ(even.points[even.Index(1, 2)], Eigen::Vector3f(2.0f, 2.0f, 5.0f));
  EXPECT_EQ(odd.range_m[odd.Index(1, 0)], 30.0f);
  EXPECT_EQ(odd.origins[0].z(), 1.0f);
}

TEST(CheckHalves, SaysThatNeitherHalfShowsTheObject) {
  KeptObject object;
  object.uuid = "u";
  object.name = "valve 3";
  object.detection = ValveDetection();
  object.options = FitValveOptions();
  object.roi =
      BoxRoi{{Eigen::Quaterniond::Identity(), {0.0, 0.0, 50.0}}, Eigen::Vector3d::Constant(0.5)};
  const auto halves = CheckHalves(Numbered(6, 4), DefaultSensorRig(), object, {}, {});
  ASSERT_TRUE(halves) << halves.error().message;
  ASSERT_EQ(halves->size(), 1u);
  EXPECT_EQ(halves->front().state, HalfFits::State::kNotSeen);
  EXPECT_EQ(halves->front().not_seen, "valve 3: not found in either half of the lines alone");
}

}  // namespace
}  // namespace foresight
