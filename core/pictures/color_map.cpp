#include "core/pictures/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"

namespace foresight {
namespace {

using Polynomial = std::array<double, 6>;

double Evaluate(const Polynomial& p, double x) {
  return p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * (p[4] + x * p[5]))));
}

std::uint8_t Byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// Turbo as the polynomial its authors give for shaders (Google, Apache 2.0).
Rgb8 Turbo(double x) {
  static const Polynomial kRed = {0.13572138,   4.61539260,    -42.66032258,
                                  132.13108234, -152.94239396, 59.28637943};
  static const Polynomial kGreen = {0.09140261,   2.19418839, 4.84296658,
                                    -14.18503333, 4.27729857, 2.82956604};
  static const Polynomial kBlue = {0.10667330,   12.64194608,  -60.58204836,
                                   110.36276771, -89.90310912, 27.34824973};
  return {Byte(Evaluate(kRed, x)), Byte(Evaluate(kGreen, x)), Byte(Evaluate(kBlue, x))};
}

using NineColors = std::array<std::array<double, 3>, 9>;

constexpr NineColors kViridis = {{{68, 1, 84},
                                  {71, 44, 122},
                                  {59, 82, 139},
                                  {44, 114, 142},
                                  {33, 145, 140},
                                  {40, 174, 128},
                                  {94, 201, 98},
                                  {173, 220, 48},
                                  {253, 231, 37}}};
constexpr NineColors kCividis = {{{0, 34, 78},
                                  {26, 56, 111},
                                  {67, 78, 108},
                                  {98, 101, 111},
                                  {125, 124, 120},
                                  {155, 149, 119},
                                  {188, 175, 111},
                                  {222, 203, 94},
                                  {254, 232, 56}}};

/// Blue and orange of Okabe and Ito, as far from white as from each other.
Rgb8 Balance(double x) {
  constexpr std::array<double, 3> kBelow = {0, 114, 178}, kAbove = {230, 120, 0};
  const std::array<double, 3>& end = x < 0.5 ? kBelow : kAbove;
  const double fraction = std::abs(2.0 * x - 1.0);
  const auto mix = [&](std::size_t channel) {
    return Byte(((1.0 - fraction) * 255.0 + fraction * end[channel]) / 255.0);
  };
  return {mix(0), mix(1), mix(2)};
}

/// A map through nine of its published colours, straight lines between them.
Rgb8 Between(const NineColors& colors, double x) {
  const double place = x * 8.0;
  const auto below = static_cast<std::size_t>(std::min(7.0, std::floor(place)));
  const double fraction = place - static_cast<double>(below);
  const auto mix = [&](std::size_t channel) {
    return Byte(
        ((1.0 - fraction) * colors[below][channel] + fraction * colors[below + 1][channel]) /
        255.0);
  };
  return {mix(0), mix(1), mix(2)};
}

constexpr std::array<ColorMapInfo, 3> kDepthMaps = {{{ColorMap::kTurbo, "Turbo"},
                                                     {ColorMap::kViridis, "Viridis"},
                                                     {ColorMap::kCividis, "Cividis"}}};

}  // namespace

Rgb8 ColorOf(ColorMap map, double value) {
  const double x = std::clamp(value, 0.0, 1.0);
  switch (map) {
    case ColorMap::kTurbo:
      return Turbo(x);
    case ColorMap::kBalance:
      return Balance(x);
    case ColorMap::kViridis:
      return Between(kViridis, x);
    case ColorMap::kCividis:
      return Between(kCividis, x);
    case ColorMap::kGray:
      break;
  }
  const std::uint8_t gray = Byte(0.15 + 0.85 * x);  // black points would vanish on the background
  return {gray, gray, gray};
}

std::span<const ColorMapInfo> DepthColorMaps() {
  return kDepthMaps;
}

ValueRange RobustRange(std::span<const float> values) {
  const std::size_t stride = std::max<std::size_t>(1, values.size() / 50'000);
  std::vector<float> finite;
  for (std::size_t i = 0; i < values.size(); i += stride)
    if (std::isfinite(values[i])) finite.push_back(values[i]);
  if (finite.empty()) return {};
  const double low = Quantile(finite, 0.01);
  return {low, std::max<double>(Quantile(std::move(finite), 0.99), low + 1e-3)};
}

}  // namespace foresight
