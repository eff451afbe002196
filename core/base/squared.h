#pragma once

namespace foresight {

constexpr double Squared(double value) {
  return value * value;
}

}  // namespace foresight
