#pragma once

#include "hardware/api/stop_capture.h"
#include "sensor_head.pb.h"

namespace foresight {

/// What was captured at stops <-> messages: images as PNG, lines packed as in a mission file, so
/// both are exact. Writers fail with kInvalidInput, readers with kBadData.

Result<link::StopEvent> ToMessage(int number, const StopCapture& capture);
Result<link::StopEvent> ToMessage(int number, ScanState end, const std::string& reason);

/// Of an event that has a capture.
Result<StopCapture> CaptureFromMessage(const link::StopEvent& event);

}  // namespace foresight
