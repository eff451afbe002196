#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/base/image.h"
#include "core/sensor/camera_model.h"
#include "core/simulation/noise_options.h"

namespace foresight {

/// The 8 bits of a level in [0, 1] under a gamma: lround(255 pow(level, 1 / gamma)), in every bit,
/// without a power for each pixel.
class ToneCurve {
 public:
  explicit ToneCurve(double gamma);
  std::uint8_t operator()(double level) const;

 private:
  static constexpr int kCells = 4096;
  std::array<double, 257> first_level_;  ///< the smallest level of each number; the last is beyond
  std::array<std::uint8_t, kCells + 1> number_at_;  ///< at the beginning of each cell of levels
};

/// Turns light into the numbers a camera sends: vignetting, shot and read noise, PRNU, saturation,
/// gain, gamma, 8 bits.
class ImageSensor {
 public:
  ImageSensor(const CameraModel& camera, const CameraNoise& noise, std::uint64_t seed);

  /// One row of image `seq`. `light`: what a white surface under light 1 gives is 1.
  void ExposeRow(std::int64_t seq, int y, double exposure_s, double gain_db,
                 std::span<const Eigen::Vector3f> light, std::span<Rgb8> pixels) const;

 private:
  CameraModel camera_;
  CameraNoise noise_;
  std::uint64_t seed_;
  double corner_px_;  ///< distance of the farthest corner from the principal point
  ToneCurve tone_;
};

}  // namespace foresight
