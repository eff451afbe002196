// The check on simulated scans of the shipped room, with the noise of real devices.
#include "core/selfcheck/check_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/evaluation/check_trial.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

const std::vector<CheckOutcome>& Outcomes() {
  static const std::vector<CheckOutcome> kOutcomes = [] {
    auto scene = LoadScene(std::string(FORESIGHT_SOURCE_DIR) + "/resources/scenes/room.yaml");
    EXPECT_TRUE(scene) << scene.error().message;
    auto outcomes = RunCheckTrial(std::make_shared<const Scene>(std::move(*scene)), 3,
                                  UsualDamages(RadiansFromDegrees(0.3), 0.010), {}, {});
    EXPECT_TRUE(outcomes) << outcomes.error().message;
    return std::move(*outcomes);
  }();
  return kOutcomes;
}

const CheckOutcome& Outcome(const std::string& damage) {
  for (const CheckOutcome& outcome : Outcomes())
    if (outcome.damage == damage) return outcome;
  throw std::logic_error("no such damage");
}

const RigFinding& Finding(const CheckOutcome& outcome, const std::string& name) {
  for (const RigFinding& finding : outcome.check.findings)
    if (finding.name == name) return finding;
  throw std::logic_error("no such finding");
}

TEST(CheckRig, IsQuietAboutAGoodRig) {
  EXPECT_THAT(Outcome("none").check.drifted, testing::IsEmpty());
  EXPECT_TRUE(Outcome("none").check.SawAnything());
}

TEST(CheckRig, FindsATurnOfTheCameraAboutEachAxis) {
  for (const char axis : {'x', 'y', 'z'}) {
    const CheckOutcome& outcome = Outcome(fmt::format("camera turn {}", axis));
    const RigFinding& finding = Finding(outcome, fmt::format("camera turn {}", axis));
    EXPECT_EQ(finding.state, RigFinding::State::kDrifted) << axis;
    // As camera_from_head was turned; 0.1 deg is a pixel of the image.
    EXPECT_NEAR(outcome.sign * finding.value, RadiansFromDegrees(0.3), RadiansFromDegrees(0.12));
  }
}

TEST(CheckRig, FindsATurnOfTheLidarAboutEachAxis) {
  for (const char axis : {'x', 'y', 'z'})
    EXPECT_TRUE(Outcome(fmt::format("lidar turn {}", axis)).check.Drifted()) << axis;
}

TEST(CheckRig, FindsAnOffsetOfTheStamps) {
  const CheckOutcome& outcome = Outcome("stamps");
  EXPECT_EQ(Finding(outcome, "stamps").state, RigFinding::State::kDrifted);
  // The motor's backlash of 0.03 deg looks like 0.75 ms at 20 deg/s.
  EXPECT_NEAR(outcome.sign * Finding(outcome, "stamps").value, 0.010, 0.0015);
}

}  // namespace
}  // namespace foresight
