#pragma once

#include <string>
#include <vector>

#include "hardware/scip/scip_clock.h"
#include "hardware/scip/scip_codec.h"
#include "hardware/scip/scip_lidar_options.h"
#include "hardware/scip/scip_session.h"

namespace foresight {

// What is said to a device, in which order. All fail with kDevice when it does not answer or
// refuses, with kState when it is in the abnormal state that only a reboot ends, and as ScipSession
// when stopped.

struct ScipIdentity {
  ScipParameters parameters;
  std::string serial;    ///< empty when not told
  std::string firmware;  ///< empty when not told
};

/// Stops whatever runs, discards what was under way, and asks who is there. Fails with
/// kInvalidInput when it is not the device of the options: another attempt will not help.
Result<ScipIdentity> Identify(ScipSession& session, const ScipLidarOptions& options);

/// The device must not be measuring.
Result<std::vector<ClockReading>> ReadDeviceClock(ScipSession& session, const SensorClock& clock,
                                                  const ScipLidarOptions& options);

/// Stops a stream that may be running and begins `request`.
Status BeginStream(ScipSession& session, const ScipRequest& request, ScipSession::Duration timeout);

/// Stops what runs. Asks twice: a single QT is sometimes ignored.
Status Quit(ScipSession& session, ScipSession::Duration timeout);

/// The connection ends with it.
Status Reboot(ScipSession& session, ScipSession::Duration timeout);

/// A timeout of the options for a wait.
ScipSession::Duration DurationOf(double seconds);

}  // namespace foresight
