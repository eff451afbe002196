#pragma once

#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/depth/aligned_samples.h"
#include "core/depth/plane_filter.h"

namespace foresight {

/// Index into the map for each place of the lidar's grid, (beam, line) = (x, y); -1 = no kept
/// sample.
Image<std::int32_t> MapGrid(const SparseDepthMap& map, const AlignedSamples& samples);

/// The samples of the map with their places among the rays, level. Where the context is cancelled
/// some are left at their defaults.
std::vector<SamplePlane> LevelPlanes(const SparseDepthMap& map, const AlignedSamples& samples,
                                     const RunContext& context = {});

/// Slopes of inverse depth towards each sample's neighbours on the lidar's grid: level, through the
/// four pairs of a neighbour on its line and one on the next, and two symmetric ones. A level start
/// alone does not find planes so steep that neighbours differ by more than about 2 sigma_d. Where
/// the context is cancelled some are left level.
std::vector<SlopeCandidates> SlopesOnGrid(const SparseDepthMap& map, const AlignedSamples& samples,
                                          std::span<const SamplePlane> planes,
                                          const RunContext& context = {});

}  // namespace foresight
