// How the head is mounted on the robot, from a board on the robot's hand.
#include "core/calibration/hand_eye.h"

#include <gmock/gmock.h>

#include "core/base/random.h"
#include "core/calibration/tangent.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

struct Scene {
  Rigid<frame::Robot, frame::Base> robot_from_base{Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5),
                                                   Eigen::Vector3d(0.1, 0.02, 1.4)};
  Rigid<frame::Hand, frame::Pattern> hand_from_board{RotationExp({0.3, -0.2, 0.1}),
                                                     Eigen::Vector3d(0.05, -0.03, 0.12)};

  /// Turns of the hand are about `axes`, taking turns.
  std::vector<HandEyeSample> Samples(const std::vector<Eigen::Vector3d>& axes, double noise,
                                     std::uint64_t seed, int count = 12) const {
    Random random(seed);
    const auto vector = [&random](double size) {
      const double x = random.Normal(), y = random.Normal(), z = random.Normal();
      return Eigen::Vector3d(size * x, size * y, size * z);
    };
    std::vector<HandEyeSample> samples;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d turn =
          random.Uniform(-0.7, 0.7) * axes[static_cast<std::size_t>(i) % axes.size()];
      const Rigid<frame::Robot, frame::Hand> hand(RotationExp(turn),
                                                  Eigen::Vector3d(0.8, 0.0, 1.2) + vector(0.15));
      const auto board = robot_from_base.Inverse() * hand * hand_from_board;
      Eigen::Matrix<double, 6, 1> error;
      error << vector(noise), vector(noise);
      samples.push_back({hand, Perturbed(board, error)});
    }
    return samples;
  }
};

const std::vector<Eigen::Vector3d> kAllAxes = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                               Eigen::Vector3d::UnitZ()};

TEST(HandEye, IsExactForExactSamples) {
  const Scene scene;
  const auto found = CalibrateHandEye(scene.Samples(kAllAxes, 0.0, 1), {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(StepBetween(scene.robot_from_base, found->robot_from_base).norm(), 1e-9);
  EXPECT_LT(StepBetween(scene.hand_from_board, found->hand_from_board).norm(), 1e-9);
}

TEST(HandEye, CovarianceIsThatOfManyTrials) {
  const Scene scene;
  HandEyeOptions options;  // the noise that the samples get
  constexpr int kTrials = 200;
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto found = CalibrateHandEye(
        scene.Samples(kAllAxes, 0.002, 100 + static_cast<std::uint64_t>(trial)), options);
    ASSERT_TRUE(found) << found.error().message;
    const auto step = StepBetween(scene.robot_from_base, found->robot_from_base);
    squares += step.cwiseAbs2().cwiseQuotient(found->covariance.diagonal()) / kTrials;
  }
  // Of 200 trials a ratio is known to 5 %; the covariance is scaled up by chance, never down.
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(std::sqrt(squares[i]), 0.8) << i;
    EXPECT_LT(std::sqrt(squares[i]), 1.15) << i;
  }
}

TEST(HandEye, RefusesTurnsAboutOneAxisAndNamesIt) {
  const auto found = CalibrateHandEye(Scene().Samples({Eigen::Vector3d::UnitZ()}, 0.001, 2), {});
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr("about one axis only"));
}

TEST(HandEye, RefusesAHandThatHardlyTurns) {
  std::vector<Eigen::Vector3d> little;
  for (const Eigen::Vector3d& axis : kAllAxes) little.push_back(0.1 * axis);
  const auto found = CalibrateHandEye(Scene().Samples(little, 0.001, 3), {});
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr("are needed"));
}

TEST(HandEye, RefusesTwoSamples) {
  EXPECT_FALSE(CalibrateHandEye(Scene().Samples(kAllAxes, 0.0, 4, 2), {}));
}

TEST(SurveyedBoards, GiveTheBaseDirectly) {
  const Scene scene;
  std::vector<SurveyedBoard> boards;
  for (const HandEyeSample& sample : scene.Samples(kAllAxes, 0.001, 5, 4))
    boards.push_back({sample.robot_from_hand * scene.hand_from_board, sample.base_from_board});
  const auto found = CalibrateSurveyed(boards, {});
  ASSERT_TRUE(found) << found.error().message;
  const auto step = StepBetween(scene.robot_from_base, found->robot_from_base);
  // Noise of 1 mrad turns boards 1 m away by 1 mm.
  EXPECT_LT(step.head<3>().norm(), 0.003);
  EXPECT_LT(step.tail<3>().norm(), 0.004);
}

}  // namespace
}  // namespace foresight
