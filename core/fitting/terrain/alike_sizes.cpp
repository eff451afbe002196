#include "core/fitting/terrain/alike_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foresight {
namespace {

/// Nats of margins, evenly apart.
struct SizeOdds {
  double first = 0.0;  ///< margin
  double step = 0.0;
  std::array<double, 14> nats = {};
};
constexpr SizeOdds kOfReturns = {
    -0.19, 0.02, {-3.2, -1.9, -2.0, -1.8, -1.3, -1.1, -1.0, -0.2, 0.0, 0.6, 1.1, 3.0, 3.6, 3.6}};
constexpr SizeOdds kOfMap = {
    -0.19, 0.02, {-6.4, -5.4, -5.3, -4.3, -4.6, -4.9, -3.3, -1.9, -0.9, 0.4, 1.7, 4.3, 5.0, 5.0}};
constexpr SizeOdds kOfReturnsAndImage = {
    -0.285, 0.03, {-6.6, -5.4, -5.3, -4.8, -3.9, -2.3, -2.0, -1.0, -0.5, 0.7, 1.8, 3.8, 4.0, 4.4}};
constexpr SizeOdds kOfMapAndImage = {
    -0.285, 0.03, {-6.8, -5.7, -5.6, -5.3, -5.2, -4.6, -3.5, -2.6, -1.1, 0.3, 2.6, 3.5, 4.3, 5.0}};

struct Fraction {
  double of_blocks;
  double prior;
};
constexpr std::array<Fraction, 7> kFractions = {
    {{0.02, 0.3}, {0.1, 0.08}, {0.3, 0.08}, {0.5, 0.08}, {0.7, 0.08}, {0.9, 0.08}, {0.98, 0.3}}};
constexpr double kWorth = 0.5;

const SizeOdds& OddsOf(bool of_map, bool in_image) {
  if (of_map) return in_image ? kOfMapAndImage : kOfMap;
  return in_image ? kOfReturnsAndImage : kOfReturns;
}

}  // namespace

double NatsOfSize(double size_margin, bool of_map, bool in_image) {
  const SizeOdds& odds = OddsOf(of_map, in_image);
  const double at = std::clamp((size_margin - odds.first) / odds.step, 0.0,
                               static_cast<double>(odds.nats.size() - 1));
  const auto low = std::min(static_cast<std::size_t>(at), odds.nats.size() - 2);
  const double beyond = at - static_cast<double>(low);
  return (1.0 - beyond) * odds.nats[low] + beyond * odds.nats[low + 1];
}

std::vector<double> NatsAmongOthers(std::span<const double> own_nats) {
  std::vector<double> among(own_nats.size());
  for (std::size_t i = 0; i < own_nats.size(); ++i) {
    // Weights of the fractions by what the others say, and with them the odds of a block.
    std::array<double, kFractions.size()> log_weights;
    for (std::size_t k = 0; k < kFractions.size(); ++k) {
      const double fraction = kFractions[k].of_blocks;
      log_weights[k] = std::log(kFractions[k].prior);
      for (std::size_t j = 0; j < own_nats.size(); ++j)
        if (j != i && !std::isnan(own_nats[j]))
          log_weights[k] += std::log(fraction * std::exp(kWorth * own_nats[j]) + 1.0 - fraction);
    }
    const double largest = *std::max_element(log_weights.begin(), log_weights.end());
    double block = 0.0, other = 0.0;
    for (std::size_t k = 0; k < kFractions.size(); ++k) {
      const double weight = std::exp(log_weights[k] - largest);
      block += weight * kFractions[k].of_blocks;
      other += weight * (1.0 - kFractions[k].of_blocks);
    }
    among[i] = std::log(block / other);
    if (!std::isnan(own_nats[i])) among[i] += kWorth * own_nats[i];
  }
  return among;
}

}  // namespace foresight
