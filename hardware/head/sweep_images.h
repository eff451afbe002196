#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/sensor/motor_track.h"
#include "hardware/api/camera.h"
#include "hardware/api/sensor_clock.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

/// The images of one scan: which trigger belongs to which angle, which images came and which
/// did not. A camera in trouble costs images, never an error: what it said is kept for later. Of
/// the head's thread alone.
class SweepImages {
 public:
  /// Images are known by their place in `angles_rad`. Camera and clock live longer.
  SweepImages(Camera& camera, const SensorClock& clock, std::vector<double> angles_rad);

  std::size_t size() const { return wanted_.size(); }
  double Angle(std::size_t image) const { return wanted_[image].angle_rad; }
  /// Whether the camera took the trigger.
  bool Trigger(std::size_t image);
  /// Takes the next image, waiting for it at most `timeout`. It finds its angle by its seq: a
  /// late one of an earlier trigger goes where it belongs, one of an earlier scan goes nowhere.
  void Receive(std::chrono::milliseconds timeout);
  /// Whether an image may still come: it was triggered, and the camera has not given it up.
  bool Waiting() const { return pending_.size() > given_up_; }
  /// When the camera last said anything, or was last asked; head's clock.
  double LastNews_s() const { return last_news_s_; }
  /// Nothing that was triggered so far is waited for any longer; it is welcome all the same.
  void StopWaiting();

  /// Hands the images around whose exposure the track is known to `sink`; `all`: no more samples
  /// will come. Returns how many.
  int HandOn(const MotorTrack& track, ScanSink& sink, bool all);

  /// The images that have not come, in their order.
  std::vector<std::size_t> Missing() const;
  /// "the images at 5.00, 12.50 deg did not come: camera ...: ..."; empty when all came.
  std::string DescribeMissing() const;

 private:
  struct Wanted {
    double angle_rad = 0.0;
    bool came = false;
  };

  Camera& camera_;
  const SensorClock& clock_;
  std::vector<Wanted> wanted_;
  std::map<std::int64_t, std::size_t> triggered_;  ///< seq -> image
  std::set<std::int64_t> pending_;
  std::size_t given_up_ = 0;  ///< of the pending ones; the camera does not say which
  double last_news_s_ = 0.0;
  std::string trouble_;              ///< the last thing that went wrong
  std::vector<CameraFrame> frames_;  ///< came, but the track does not reach beyond them yet
};

}  // namespace foresight
