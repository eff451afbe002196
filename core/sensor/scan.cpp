#include "core/sensor/scan.h"

#include <cmath>
#include <random>

namespace foresight {

const char* ToString(ScanState state) {
  switch (state) {
    case ScanState::kRunning:
      return "running";
    case ScanState::kComplete:
      return "complete";
    case ScanState::kAborted:
      return "aborted";
    case ScanState::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

Result<ScanState> ScanStateFromString(const std::string& text) {
  for (const ScanState state :
       {ScanState::kRunning, ScanState::kComplete, ScanState::kAborted, ScanState::kInterrupted})
    if (text == ToString(state)) return state;
  return Fail(ErrorCode::kBadData, "scan state '{}' is not known", text);
}

const CameraFrame* NearestFrame(const Scan& scan, double angle_rad) {
  const CameraFrame* nearest = nullptr;
  for (const CameraFrame& frame : scan.frames)
    if (nearest == nullptr || std::abs(frame.motor_angle_rad - angle_rad) <
                                  std::abs(nearest->motor_angle_rad - angle_rad))
      nearest = &frame;
  return nearest;
}

std::int64_t BeginUtc_ns(const Scan& scan) {
  double begin_s = 0.0;
  if (!scan.lines.empty())
    begin_s = scan.lines.front().time_s;
  else if (!scan.track.samples().empty())
    begin_s = scan.track.samples().front().time_s;
  else
    begin_s = scan.given.FirstTime_s();
  return scan.start_utc_ns + static_cast<std::int64_t>(1e9 * begin_s);
}

std::string NewUuid() {
  std::random_device device;
  const auto word = [&] { return device(); };
  const unsigned a = word(), b = word(), c = word(), d = word();
  return fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:04x}{:08x}", a, b >> 16, b & 0xfffU,
                     0x8000U | (c >> 16 & 0x3fffU), c & 0xffffU, d);
}

}  // namespace foresight
