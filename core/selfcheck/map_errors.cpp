#include "core/selfcheck/map_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/quantile.h"

namespace foresight {
namespace {

using BeamsByPlace = std::map<std::pair<int, int>, const HeldOutBeam*>;

const HeldOutBeam* At(const BeamsByPlace& beams, int line, int beam) {
  const auto found = beams.find({line, beam});
  return found == beams.end() ? nullptr : found->second;
}

/// The deviation of single beams along a line, by distance: two classes an octave.
class BeamNoise {
 public:
  explicit BeamNoise(const BeamsByPlace& beams) {
    std::map<int, std::vector<double>> differences_m;
    for (const auto& [place, beam] : beams)
      if (const HeldOutBeam* next = At(beams, place.first, place.second + 1))
        differences_m[ClassOf(beam->depth_m)].push_back(
            std::abs(beam->Error_m() - next->Error_m()));
    constexpr double kMedianToSigma = 1.4826;
    for (auto& [distance, values] : differences_m)
      sigmas_m_[distance] = kMedianToSigma / std::sqrt(2.0) * Quantile(std::move(values), 0.5);
  }

  double Sigma_m(double depth_m) const {
    const auto found = sigmas_m_.find(ClassOf(depth_m));
    return found == sigmas_m_.end() ? 0.0 : found->second;
  }

 private:
  static int ClassOf(double depth_m) {
    return static_cast<int>(std::floor(2.0 * std::log2(depth_m)));
  }

  std::map<int, double> sigmas_m_;
};

}  // namespace

std::vector<NoisyError> MapErrors(const std::vector<HeldOutBeam>& lines) {
  BeamsByPlace beams;
  for (const HeldOutBeam& beam : lines)
    if (beam.kept && std::isfinite(beam.Error_m())) beams[{beam.line, beam.beam}] = &beam;
  const BeamNoise noise(beams);
  constexpr double kSigmas = 6.0;
  constexpr int kBeams = 4;
  std::vector<NoisyError> errors;
  for (const auto& [place, first] : beams) {
    // The mean along each of the two lines.
    std::array<double, 2> means_m = {0.0, 0.0};
    double least_m = first->Error_m(), most_m = least_m;
    bool all = true;
    for (int i = 0; all && i < 2 * kBeams; ++i) {
      const HeldOutBeam* one = At(beams, place.first + i / kBeams, place.second + i % kBeams);
      all = one != nullptr;
      if (!all) break;
      means_m[static_cast<std::size_t>(i / kBeams)] += one->Error_m() / kBeams;
      least_m = std::min(least_m, one->Error_m());
      most_m = std::max(most_m, one->Error_m());
    }
    if (!all) continue;
    if (most_m - least_m >
        std::max(RightWithin_m(first->depth_m), kSigmas * noise.Sigma_m(first->depth_m)))
      errors.push_back({first->Error_m(), 0.0});
    else
      errors.push_back({0.5 * (means_m[0] + means_m[1]), 0.5 * (means_m[0] - means_m[1])});
  }
  return errors;
}

}  // namespace foresight
