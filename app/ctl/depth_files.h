#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "core/depth/pipeline.h"

namespace foresight {

/// Command-line options that every command with a depth pipeline has.
struct DepthArguments {
  double threshold = 0.35;
  double sigma_spatial_px = 0.0;
  int iterations = 5;
};

void AddDepthArguments(CLI::App& command, DepthArguments& arguments);
DepthOptions DepthOptionsFrom(const DepthArguments& arguments);

/// Writes depth.pfm (millimetres, NaN = none), confidence.pfm and mask.png into an existing folder.
Status WriteDepthFiles(const DepthResult& result, const std::filesystem::path& folder);

/// A line on standard error when the density is below the paper's floor of 2 %.
void WarnOfLowDensity(const DepthResult& result);

}  // namespace foresight
