#include "app/ctl/depth_files.h"

#include "core/depth/depth_method.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

void AddDepthArguments(CLI::App& command, DepthArguments& arguments) {
  command.add_option("--method", arguments.method, "Depth method: " + MethodNames())
      ->capture_default_str();
  command
      .add_option("--threshold", arguments.threshold,
                  "Confidence below this share of the largest is masked")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--sigma-spatial", arguments.sigma_spatial_px,
                  "sigma_s in pixels; 0 = from the density")
      ->capture_default_str();
  command.add_option("--iterations", arguments.iterations, "Passes after the first")
      ->check(CLI::Range(0, 50));
}

std::string MethodNames() {
  std::string names;
  for (const DepthMethodInfo& info : DepthMethods())
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

Result<DepthOptions> DepthOptionsFrom(const DepthArguments& arguments) {
  FORESIGHT_TRY(const DepthMethod method, DepthMethodFromName(arguments.method));
  DepthOptions options = DefaultsOf(method);
  if (arguments.threshold >= 0.0) options.mask.threshold = arguments.threshold;
  options.upsample.sigma_spatial_px = arguments.sigma_spatial_px;
  if (arguments.iterations >= 0) options.upsample.iterations = arguments.iterations;
  return options;
}

Status WriteDepthFiles(const DepthResult& result, const std::filesystem::path& folder) {
  FloatImage depth_mm = result.dense.depth_m;
  for (float& value : depth_mm.values()) value *= 1000.0f;
  FORESIGHT_CHECK(WritePfm(folder / "depth.pfm", depth_mm));
  FORESIGHT_CHECK(WritePfm(folder / "confidence.pfm", result.dense.confidence));
  return WritePng(folder / "mask.png", result.mask);
}

void WarnOfLowDensity(const DepthResult& result) {
  const double density = LocalDensity(result.samples);
  if (density < ScanPrediction::kMinDensity)
    fmt::print(stderr,
               "only {:.2f} % of the pixels are measured; below {:.0f} % the depth map is not to "
               "be trusted\n",
               100.0 * density, 100.0 * ScanPrediction::kMinDensity);
}

}  // namespace foresight
