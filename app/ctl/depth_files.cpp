#include "app/ctl/depth_files.h"

#include "app/common/output.h"
#include "core/depth/depth_method.h"
#include "core/depth/depth_option_table.h"
#include "core/io/pfm.h"
#include "core/io/png.h"

namespace foresight {

void AddDepthArguments(CLI::App& command, DepthArguments& arguments) {
  const std::string group = command.option_defaults()->get_group();
  command.option_defaults()->group("Depth map");
  command.add_option("--method", arguments.method, "Depth method: " + MethodNames())
      ->capture_default_str();
  AddOptionFlags(command, DepthOptionTable(), arguments.given);
  command.option_defaults()->group(group);
}

std::vector<std::string> DepthOptionNames() {
  std::vector<std::string> names = FlagsOf(DepthOptionTable());
  names.insert(names.begin(), "--method");
  return names;
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
  FORESIGHT_CHECK(ApplyFlags(DepthOptionTable(), arguments.given,
                             fmt::format("method '{}'", arguments.method), options));
  options.local_plane.keep_iterations = true;  // for the change of each pass, Fig. 6(b)
  FORESIGHT_CHECK(options.Check());
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
  if (!result.BelowDensityFloor()) return;
  PrintNote(
      "only {:.2f} % of the pixels are measured; below {:.0f} % the depth map is not to be trusted",
      100.0 * result.density, 100.0 * ScanPrediction::kMinDensity);
}

}  // namespace foresight
