#pragma once

#include <memory>
#include <optional>

#include "hardware/api/live_view.h"
#include "hardware/head/head_devices.h"

namespace foresight {

/// One live view: takes an image whenever the next one is due, and never waits for it. Of the
/// head's thread alone.
class LiveView {
 public:
  LiveView(const LiveViewOptions& options, std::shared_ptr<LiveViewSink> sink);

  /// The camera may have been used by others since the last look.
  void Forget();
  /// Triggers what is due and hands on what has come.
  void Look(Camera& camera, const SensorClock& clock, double motor_angle_rad);

 private:
  void Trigger(Camera& camera, double now_s);
  void HandOn(const CameraFrame& frame, double motor_angle_rad);
  void Trouble(const std::string& what);

  const LiveViewOptions options_;
  const std::shared_ptr<LiveViewSink> sink_;
  bool configured_ = false;
  std::optional<std::int64_t> waits_for_;  ///< seq of the image that was triggered
  double triggered_s_ = 0.0;
  double next_s_ = 0.0;
  std::string told_;  ///< trouble that the sink knows of
};

}  // namespace foresight
