#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/calibration/hand_eye.h"
#include "core/sensor/robot_frame_source.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// Boards whose places the robot knows, as the head sees them.
struct RobotFrameSamples {
  RobotFrameSource source = RobotFrameSource::kHandEye;  ///< or kSurveyedBoards
  struct Sample {
    std::string name;
    Rigid<frame::Robot, frame::Hand> robot_from_hand;  ///< of surveyed boards: that of the board
    Rigid<frame::Base, frame::Pattern> base_from_board;
  };
  std::vector<Sample> samples;
  std::vector<std::string> left_out;  ///< images without the board, and why
};

/// Reads a file of samples, docs/formats.md; boards are looked for in its images with the rig's
/// camera. Fails with kIo; with kBadData, naming file, line and what is wrong there.
Result<RobotFrameSamples> ReadRobotFrameSamples(const std::filesystem::path& path,
                                                const SensorRig& rig, const RunContext& context);

/// CalibrateHandEye or CalibrateSurveyed, with what each sample is off by.
struct RobotFrameCalibration {
  HandEyeCalibration found;
  struct Residual {
    std::string name;
    double turn_rad = 0.0;
    double shift_m = 0.0;
  };
  std::vector<Residual> residuals;
};
Result<RobotFrameCalibration> CalibrateRobotFrame(const RobotFrameSamples& samples,
                                                  const HandEyeOptions& options);

}  // namespace foresight
