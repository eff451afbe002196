#pragma once

#include <bit>
#include <cstdint>

namespace foresight {

/// exp(x) for -87 <= x <= 0 with a relative error below 3e-7; smaller x gives a value below 1e-37.
/// Free of branches and calls, so that a compiler can vectorise a loop over it.
inline float ExpOfNegative(float x) {
  const float clamped = x < -87.0f ? -87.0f : x;
  const float t = clamped * 1.44269504f;
  const auto whole = static_cast<std::int32_t>(t - 0.5f);  // rounds to nearest, as t <= 0
  // ln 2 in two parts, so that the rest keeps its digits.
  const auto n = static_cast<float>(whole);
  const float rest = (clamped - n * 0.693359375f) + n * 2.12194440e-4f;
  float p = 1.9875691500e-4f;
  p = p * rest + 1.3981999507e-3f;
  p = p * rest + 8.3334519073e-3f;
  p = p * rest + 4.1665795894e-2f;
  p = p * rest + 1.6666665459e-1f;
  p = p * rest + 5.0000001201e-1f;
  p = p * rest * rest + rest + 1.0f;
  return p * std::bit_cast<float>((whole + 127) << 23);
}

}  // namespace foresight
