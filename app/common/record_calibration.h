#pragma once

#include <optional>
#include <string>

#include "core/base/run_context.h"
#include "core/calibration/session_folder.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// What is captured before a stand that stands still.
struct PoseRecording {
  std::string name;  ///< of the place; empty = "pose N"
  StopPlan stops;
  std::optional<ScanPlan> sweep;  ///< up and down; nullopt = none
};

/// What has come, and is in the session.
struct RecordedPose {
  int stops = 0;
  int images = 0;
  bool sweep = false;
  std::string missing;  ///< what did not come and why, one sentence; empty = nothing
};

/// Captures at all stops, then sweeps; each capture goes into the session's folder as it comes.
/// Progress goes to standard error. Cancelling ends the captures and keeps what has come. The head
/// is ready. Fails with kDevice where the head ends in a fault, kIo where the disk does; what came
/// is kept then, too.
Result<RecordedPose> RecordPose(SensorHead& head, const PoseRecording& recording,
                                SessionFolder& folder, const RunContext& context);

/// Adds one image, taken at an angle of the motor, to the intrinsic views. Fails as RecordPose, and
/// with kDevice where no image came.
Status RecordIntrinsicView(SensorHead& head, const StopPlan& stop, const std::string& origin,
                           SessionFolder& folder, const RunContext& context);

}  // namespace foresight
