#pragma once

#include <numbers>

namespace foresight {

constexpr double RadiansFromDegrees(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
constexpr double DegreesFromRadians(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

}  // namespace foresight
