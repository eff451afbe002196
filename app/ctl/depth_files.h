#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/depth/pipeline.h"

namespace foresight {

/// Flying points by one word: the rules of FlyingPointOptions with what belongs to each.
enum class FlyingRule { kMax, kMin, kAdaptive, kOff };

/// Command-line options that every command with a depth pipeline has. What is not given is the
/// method's own.
struct DepthArguments {
  std::string method = "foresight";
  double sigma_spatial_px = 0.0;  ///< 0 = from the density
  std::optional<int> iterations;
  std::optional<double> radius_in_sigmas;
  std::optional<UpsampleOptions::Weights> weights;

  std::optional<FlyingRule> flying;
  std::optional<double> flying_threshold_mm;
  std::optional<bool> isolated;
  std::optional<FlippingPointOptions::Test> flipping;
  std::optional<double> flip_margin_mm;
  std::optional<double> flip_step_mm;
  std::optional<FlippingPointOptions::Cells> cells;

  std::optional<ConfidencePasses> confidence_passes;
  std::optional<UpsampleOptions::Weights> confidence_terms;
  std::optional<double> threshold;
  std::optional<ConfidenceMaskOptions::Reference> mask_reference;
};

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
