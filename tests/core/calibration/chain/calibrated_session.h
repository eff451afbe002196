#pragma once

#include <gtest/gtest.h>

#include "core/calibration/calibrate_chain.h"
#include "core/calibration/compare_rigs.h"
#include "core/evaluation/simulate_calibration.h"

namespace foresight::samples {

/// A simulated session, calibrated; the test fails where it is not.
struct CalibratedSession {
  SimulatedCalibration made;
  ChainCalibration found;
  RigError error;
};

/// The camera starts from the drawn one, 601 px and k = 0.9413, the lidar 5 deg and 100 mm off.
inline CalibratedSession CalibrateSimulated(const CalibrationSimulation& options,
                                            const ChainCalibrationOptions& chain = {}) {
  CalibratedSession session;
  auto made = SimulateCalibration(options);
  EXPECT_TRUE(made) << made.error().message;
  if (!made) return session;
  session.made = std::move(*made);
  auto found = CalibrateChain(session.made.session, chain, {});
  EXPECT_TRUE(found) << "seed " << options.seed << ": " << found.error().message;
  if (!found) return session;
  session.found = std::move(*found);
  session.error = CompareRigs(session.found.rig, session.made.truth).value();
  return session;
}

}  // namespace foresight::samples
