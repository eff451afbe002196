#pragma once

#include <gtest/gtest.h>

#include <QString>

#include "core/calibration/session_file.h"
#include "core/evaluation/simulate_calibration.h"

namespace foresight {

/// A small session: found and solved in about a second. Its truth is near DefaultSensorRig().
inline SimulatedCalibration WriteSmallSession(const QString& folder, int poses = 4) {
  CalibrationSimulation options;
  options.seed = 4;
  options.intrinsic_views = 8;
  options.poses = poses;
  options.scans_per_stop = 10;
  options.sweeps = 1;
  auto made = SimulateCalibration(options);
  EXPECT_TRUE(made) << made.error().message;
  const Status written = WriteCalibrationSession(made->session, folder.toStdString());
  EXPECT_TRUE(written) << written.error().message;
  return std::move(*made);
}

}  // namespace foresight
