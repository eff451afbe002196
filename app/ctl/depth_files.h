#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "core/depth/pipeline.h"

namespace foresight {

/// Command-line options that every command with a depth pipeline has.
struct DepthArguments {
  std::string method = "foresight";
  double threshold = -1.0;  ///< negative = the method's own
  double sigma_spatial_px = 0.0;
  int iterations = -1;  ///< negative = the method's own
};

void AddDepthArguments(CLI::App& command, DepthArguments& arguments);
/// Fails with kInvalidOptions for an unknown method.
Result<DepthOptions> DepthOptionsFrom(const DepthArguments& arguments);
/// "paper, jbu, ..."
std::string MethodNames();

/// Writes depth.pfm (millimetres, NaN = none), confidence.pfm and mask.png into an existing folder.
Status WriteDepthFiles(const DepthResult& result, const std::filesystem::path& folder);

/// A line on standard error when the density is below the paper's floor of 2 %.
void WarnOfLowDensity(const DepthResult& result);

}  // namespace foresight
