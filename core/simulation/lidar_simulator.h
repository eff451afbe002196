#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/sensor_rig.h"
#include "core/simulation/noise_options.h"
#include "core/simulation/ray_caster.h"

namespace foresight {

/// What the lidar on the plate measures: rays over each beam's footprint, echoes merged as a pulse
/// merges them, then noise and quantisation. `caster` outlives the simulator.
class LidarSimulator {
 public:
  /// Codes below LidarLine::kFirstValidRange_mm.
  static constexpr std::uint16_t kNoEcho = 1;
  static constexpr std::uint16_t kTooNear = 2;

  LidarSimulator(const RayCaster& caster, const SensorRig& true_rig, const LidarNoise& noise,
                 std::uint64_t seed);

  /// `plate_rad_at` gives the plate's true angle at a time.
  LidarLine Measure(std::int64_t seq, double time_s,
                    const std::function<double(double)>& plate_rad_at) const;

 private:
  struct Echo {
    double range_m = 0.0;
    double power = 0.0;
  };
  struct Reading {
    std::uint16_t range_mm = kNoEcho;
    std::uint16_t intensity = 0;
  };

  std::vector<SceneRay> RaysOfLine(double time_s,
                                   const std::function<double(double)>& plate_rad_at) const;
  double ReturnPower(const SceneRay& ray, const SceneHit& hit) const;
  /// What one ray of a footprint brings back: of a translucent surface also what lies behind it.
  void AddReturns(const SceneRay& ray, const SceneHit& hit, double divisor,
                  std::vector<Echo>& returns) const;
  Echo ReturnOf(const SceneRay& ray, const SceneHit& hit, double divisor) const;
  double RangeError(double normal, Random& random) const;
  /// Merges and sorts `returns`; nullopt when there are none.
  std::optional<Echo> StrongestEcho(std::vector<Echo>& returns) const;
  std::optional<Echo> AddNoise(const std::optional<Echo>& echo, Random& random) const;
  Reading Report(const std::optional<Echo>& echo) const;

  const RayCaster& caster_;
  LidarModel lidar_;
  Rigid<frame::Head, frame::Lidar> head_from_lidar_;
  Rigid<frame::Robot, frame::Base> robot_from_base_;
  LidarNoise noise_;
  std::uint64_t seed_;
  /// One of the rays that a beam is made of.
  struct FootprintRay {
    Eigen::Vector3d direction;  ///< around the x axis
    double divisor = 1.0;       ///< 1 / its part of the beam's light
  };
  static std::vector<FootprintRay> FootprintOf(const LidarNoise& noise);
  std::vector<FootprintRay> footprint_;
};

}  // namespace foresight
