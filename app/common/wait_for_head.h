#pragma once

#include <functional>
#include <initializer_list>

#include "core/base/run_context.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// Waits until the head leaves `states`, and stands for the operator meanwhile; a cancelled context
/// ends what the head does and stops the motor. `meanwhile` is called again and again.
HeadStatus WaitWhile(SensorHead& head, std::initializer_list<HeadState> states,
                     const RunContext& context, const std::function<void()>& meanwhile = {});

/// Waits for the end of what a head gives: over a link it comes after the head's own. Stands for
/// the operator meanwhile. False where that was cancelled, and the end does not come in a while
/// either.
bool WaitForEnd(SensorHead& head, const std::function<bool()>& ended, const RunContext& context,
                const std::function<void()>& meanwhile = {});

/// Fails with kDevice, also where that was cancelled.
Status HomeAndWait(SensorHead& head, const RunContext& context);

}  // namespace foresight
