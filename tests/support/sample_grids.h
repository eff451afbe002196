#pragma once

#include <functional>
#include <stdexcept>

#include "core/depth/aligned_samples.h"

namespace foresight {

/// Samples on a regular lattice of an image seen by a pinhole with f = 500 px, `depth_m(u, v)`
/// metres away. NaN leaves a place of the lidar's grid empty.
inline AlignedSamples SamplesOnLattice(int width, int height, int step_u, int step_v,
                                       const std::function<double(int, int)>& depth_m) {
  AlignedSamples samples;
  samples.width = width;
  samples.height = height;
  samples.beams = (width + step_u - 1) / step_u;
  samples.lines = (height + step_v - 1) / step_v;
  for (int line = 0; line < samples.lines; ++line)
    for (int beam = 0; beam < samples.beams; ++beam) {
      const int u = beam * step_u;
      const int v = line * step_v;
      const auto z = static_cast<float>(depth_m(u, v));
      if (!(z > 0.0f)) continue;
      const auto x = static_cast<float>(u - width / 2) * z / 500.0f;
      const auto y = static_cast<float>(v - height / 2) * z / 500.0f;
      samples.samples.push_back(
          {static_cast<float>(u), static_cast<float>(v), z, line, beam, {x, y, z}});
    }
  samples.reasons.assign(samples.samples.size(), RejectReason::kKept);
  return samples;
}

/// The reason at a place of the lidar's grid.
inline RejectReason ReasonAt(const AlignedSamples& samples, int line, int beam) {
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.samples[i].line == line && samples.samples[i].beam == beam)
      return samples.reasons[i];
  throw std::out_of_range("no sample there");
}

}  // namespace foresight
