#pragma once

#include <cmath>

namespace foresight {

/// A margin between likelihoods as evidence for a verdict's probability: sign and log(1 + |nats|),
/// as the first ten nats say more than the next hundred.
inline double Compressed(double nats) {
  return std::copysign(std::log1p(std::abs(nats)), nats);
}

/// The nats that Compressed made a value of.
inline double Expanded(double value) {
  return std::copysign(std::expm1(std::abs(value)), value);
}

}  // namespace foresight
