#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"

namespace foresight {

namespace frame {
struct Hand {  ///< what the robot's kinematics tells the pose of: a hand that holds a board
  static constexpr const char* kName = "hand";
};
}  // namespace frame

/// A board on the robot's hand, seen by the head: what the kinematics said and what was measured.
struct HandEyeSample {
  Rigid<frame::Robot, frame::Hand> robot_from_hand;
  Rigid<frame::Base, frame::Pattern> base_from_board;
};

/// A board at a surveyed place.
struct SurveyedBoard {
  Rigid<frame::Robot, frame::Pattern> robot_from_board;
  Rigid<frame::Base, frame::Pattern> base_from_board;
};

struct HandEyeOptions {
  double sigma_turn_rad = 0.002;  ///< of a sample, kinematics and camera together
  double sigma_shift_m = 0.002;
  /// Motions whose axes spread less than this leave the place of the base open along them: sine of
  /// the spread, 1 = evenly in two directions.
  double least_spread = 0.2;
  double least_turn_rad = 0.26;  ///< 15 deg: of the motions, rms

  Status Check() const;
};

/// How the head is mounted on the robot.
struct HandEyeCalibration {
  Rigid<frame::Robot, frame::Base> robot_from_base;
  Rigid<frame::Hand, frame::Pattern> hand_from_board;  ///< identity for surveyed boards
  /// Of robot_from_base, a step in base: turn, then shift (tangent.h). Scaled by the residuals
  /// where they are larger than the sigmas say.
  Eigen::Matrix<double, 6, 6> covariance;
  double turn_rms_rad = 0.0;  ///< of the residuals
  double shift_rms_m = 0.0;
  double spread = 0.0;    ///< of the motions' axes, see HandEyeOptions
  double turn_rad = 0.0;  ///< of the motions, rms
};

/// robot_from_hand hand_from_board = robot_from_base base_from_board for all samples, both unknown
/// (AX = ZB), from a start by relative motions (AX = XB). Needs 3 samples; fails with kTooFewPoints
/// where the hand did not turn enough, or about one axis only, and says which way to turn it.
Result<HandEyeCalibration> CalibrateHandEye(const std::vector<HandEyeSample>& samples,
                                            const HandEyeOptions& options);

/// robot_from_board = robot_from_base base_from_board. One board is enough, though only more show a
/// mistake. Fails with kTooFewPoints for none.
Result<HandEyeCalibration> CalibrateSurveyed(const std::vector<SurveyedBoard>& boards,
                                             const HandEyeOptions& options);

}  // namespace foresight
