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

/// Fails with kDevice, also where that was cancelled.
Status HomeAndWait(SensorHead& head, const RunContext& context);

}  // namespace foresight
