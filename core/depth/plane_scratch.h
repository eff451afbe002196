#pragma once

#include <cstdint>
#include <vector>

#include "core/depth/filter_scratch.h"

namespace foresight {

/// One sample seen from a tile, in units that keep all numbers near 1.
struct PlaneSample {
  float x;              ///< from the tile's origin, in sigma_s
  float y;              ///< likewise
  float inverse_depth;  ///< times the origin's depth, minus 1
  float per_metre;      ///< H is 2^-(residual * per_metre)^2
};

/// What a thread needs to filter rows; kept from one block to the next.
struct PlaneFilterScratch {
  SampleBand band;
  std::vector<std::int32_t> selected;
  PaddedRows input;                  ///< the three planes of colour, then x and y of the rays
  PaddedRows output;                 ///< in the order of PlaneFilterOutput
  AlignedFloats weight;              ///< of the samples in reach: G K and G
  std::vector<PlaneSample> samples;  ///< in reach
};

/// Out of line: gcc otherwise asks for the thread's address again and again inside a kernel.
PlaneFilterScratch& PlaneScratchOfThisThread();

}  // namespace foresight
