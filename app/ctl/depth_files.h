#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "app/common/option_flags.h"
#include "core/depth/pipeline.h"

namespace foresight {

/// Command-line options that every command with a depth pipeline has. What is not given is the
/// method's own.
struct DepthArguments {
  std::string method = "foresight";
  GivenFlags given;  ///< of DepthOptionTable
};

/// Below a heading of their own in the help.
void AddDepthArguments(CLI::App& command, DepthArguments& arguments);
/// What AddDepthArguments adds: "--method", ...
std::vector<std::string> DepthOptionNames();
/// Fails with kInvalidOptions for an unknown method, or an option that the method does not have.
Result<DepthOptions> DepthOptionsFrom(const DepthArguments& arguments);
/// "paper, jbu, ..."
std::string MethodNames();

/// Writes depth.pfm (millimetres, NaN = none), confidence.pfm and mask.png into an existing folder.
Status WriteDepthFiles(const DepthResult& result, const std::filesystem::path& folder);

/// A line on standard error when the density is below the paper's floor of 2 %.
void WarnOfLowDensity(const DepthResult& result);

}  // namespace foresight
