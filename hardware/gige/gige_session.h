#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/image.h"
#include "core/base/result.h"
#include "hardware/api/camera.h"
#include "hardware/api/sensor_clock.h"
#include "hardware/gige/camera_clock.h"
#include "hardware/gige/gige_camera_options.h"

namespace foresight {

/// One connection to a GigE Vision camera through Aravis, from taking control to losing it.
/// Configured for software triggers and acquiring from the beginning.
///
/// Every call to a camera that is gone blocks for 2.5 s (Aravis asks five times), opening too, and
/// the destructor for up to 10 s: belongs to a thread that nobody waits for. Errors are kDevice and
/// say what was asked for; answering() tells a silent camera from one that refuses.
class GigeSession {
 public:
  struct Identity {
    std::string vendor;
    std::string model;
    std::string serial;
  };
  struct Limits {
    double shortest_s = 0.0;  ///< exposure
    double longest_s = 0.0;
    double lowest_db = 0.0;
    double highest_db = 0.0;
  };
  struct ReceivedImage {
    bool complete = false;  ///< the rest is empty otherwise
    double device_s = 0.0;  ///< the device's stamp
    ColorImage image;
  };
  struct Counts {
    std::int64_t underruns = 0;
    std::int64_t resent_packets = 0;
    std::int64_t missing_packets = 0;
  };

  /// `wake` is called from a thread of Aravis when an image has come; it lives as long as the
  /// session. Loss of control shows in answering(). Fails also while another client controls the
  /// camera.
  static Result<std::unique_ptr<GigeSession>> Open(const GigeCameraOptions& options,
                                                   std::function<void()> wake);
  ~GigeSession();
  GigeSession(const GigeSession&) = delete;
  GigeSession& operator=(const GigeSession&) = delete;

  Identity identity() const;
  const Limits& limits() const;
  /// Returns the settings that the camera has made of it.
  Result<CameraSettings> Apply(const CameraSettings& settings);
  Status Trigger();
  /// The next image that has come; nullopt when none has.
  std::optional<ReceivedImage> TakeImage();

  /// Whether the camera has a clock of its own.
  bool HasClock() const;
  Result<CameraClock::Reading> ReadClock(const SensorClock& clock);
  /// NaN when the camera has no thermometer.
  double ReadTemperature_c();
  /// Asks for an answer.
  Status Probe();
  /// No call has timed out and control has not been lost.
  bool answering() const;
  Counts counts() const;

 private:
  struct Impl;
  explicit GigeSession(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
