#include "core/simulation/image_sensor.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/contract.h"
#include "core/simulation/noise_stream.h"

namespace foresight {

ToneCurve::ToneCurve(double gamma) {
  const auto number_of = [gamma](double level) {
    return std::lround(255.0 * std::pow(level, 1.0 / gamma));
  };
  for (int number = 0; number < 256; ++number) {
    // Doubles from 0 to 1 are in the order of their bits.
    auto low = std::bit_cast<std::uint64_t>(0.0), high = std::bit_cast<std::uint64_t>(1.0);
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (number_of(std::bit_cast<double>(middle)) >= number)
        high = middle;
      else
        low = middle + 1;
    }
    first_level_[static_cast<std::size_t>(number)] = std::bit_cast<double>(low);
  }
  first_level_[256] = 2.0;
  for (int cell = 0; cell <= kCells; ++cell)
    number_at_[static_cast<std::size_t>(cell)] =
        static_cast<std::uint8_t>(number_of(static_cast<double>(cell) / kCells));
}

std::uint8_t ToneCurve::operator()(double level) const {
  std::size_t number = number_at_[static_cast<std::size_t>(level * kCells)];
  while (level >= first_level_[number + 1]) ++number;
  return static_cast<std::uint8_t>(number);
}

ImageSensor::ImageSensor(const CameraModel& camera, const CameraNoise& noise, std::uint64_t seed)
    : camera_(camera),
      noise_(noise),
      seed_(seed),
      corner_px_(std::hypot(std::max(camera.cx, camera.width - 1.0 - camera.cx),
                            std::max(camera.cy, camera.height - 1.0 - camera.cy))),
      tone_(noise.gamma) {}

void ImageSensor::ExposeRow(std::int64_t seq, int y, double exposure_s, double gain_db,
                            std::span<const Eigen::Vector3f> light, std::span<Rgb8> pixels) const {
  FORESIGHT_EXPECTS(light.size() == pixels.size(), "light for every pixel");
  const double electrons_per_light = noise_.full_well_e * exposure_s / noise_.exposure_for_white_s;
  const double number_per_electron = std::pow(10.0, gain_db / 20.0) / noise_.full_well_e;
  Random random = NoiseStream(seed_, NoisePurpose::kImageRow, seq, y);
  // The gains of the pixels belong to the chip: the same in every image.
  Random gains = NoiseStream(seed_, NoisePurpose::kPixelGain, 0, y);
  const auto number_of = [&](double light_value, double sensitivity) {
    double electrons = light_value * sensitivity * electrons_per_light;
    if (noise_.enabled)
      // Shot noise is Poisson; with read noise beneath, its normal form differs nowhere visibly.
      electrons +=
          random.Normal() * std::sqrt(electrons + noise_.read_noise_e * noise_.read_noise_e);
    electrons = std::clamp(electrons, 0.0, noise_.full_well_e);
    return tone_(std::min(1.0, electrons * number_per_electron));
  };
  for (std::size_t x = 0; x < pixels.size(); ++x) {
    double sensitivity = 1.0;
    if (noise_.enabled) {
      const double right = static_cast<double>(x) - camera_.cx, down = y - camera_.cy;
      const double radius = std::sqrt(right * right + down * down);
      const double to_corner = corner_px_ > 0.0 ? radius / corner_px_ : 0.0;
      sensitivity = (1.0 - noise_.vignetting * to_corner * to_corner) *
                    std::max(0.0, 1.0 + noise_.pixel_gain_spread * gains.Normal());
    }
    pixels[x] = {number_of(light[x].x(), sensitivity), number_of(light[x].y(), sensitivity),
                 number_of(light[x].z(), sensitivity)};
  }
}

}  // namespace foresight
