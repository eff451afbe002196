#include <memory>

#include "app/ctl/change_chart.h"
#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "core/depth/imported_samples.h"
#include "core/io/png.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

struct UpsampleArguments {
  std::string image;
  std::string samples;
  std::string rig;
  std::string out = ".";
  DepthArguments depth;
  bool json = false;
};

void PrintSummary(const UpsampleArguments& arguments, const DepthResult& result, int outside) {
  const std::size_t count = result.samples.samples.size();
  if (arguments.json) {
    PrintJson({{"method", arguments.depth.method},
               {"samples", count},
               {"outside", outside},
               {"rejected", count - result.samples.KeptCount()},
               {"density", result.density},
               {"below_density_floor", result.BelowDensityFloor()},
               {"sigma_spatial_px", result.dense.sigma_spatial_px},
               {"mean_change_mm", ChangeJson(result.dense)},
               {"seconds", result.seconds},
               {"out", arguments.out}});
    return;
  }
  PrintLine(
      fmt::format("{}: depth.pfm, confidence.pfm, mask.png from {} samples, {} rejected, {:.2f} s",
                  arguments.out, count, count - result.samples.KeptCount(), result.seconds));
}

Result<ExitCode> Upsample(const UpsampleArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const DepthOptions options, DepthOptionsFrom(arguments.depth));
  FORESIGHT_TRY(const ColorImage image, ReadPng(arguments.image));
  FORESIGHT_TRY(const std::vector<CsvSample> rows, ReadCsvSamples(arguments.samples));
  SensorRig rig;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(rig, LoadSensorRig(arguments.rig));
  }
  int outside = 0;
  FORESIGHT_TRY(AlignedSamples samples, ImportSamples(rows, image.width(), image.height(),
                                                      arguments.rig.empty() ? nullptr : &rig.camera,
                                                      arguments.samples, &outside));
  if (arguments.rig.empty()) PrintNote("no --rig: Eq. (7) compares depths instead of points");
  if (outside > 0)
    PrintNote("{}: {} samples outside the image are left out", arguments.samples, outside);
  FORESIGHT_TRY(
      const DepthResult result,
      ComputeDepth(std::move(samples), image, options, context).map_error(Of(arguments.samples)));
  WarnOfLowDensity(result);
  FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
  FORESIGHT_CHECK(WriteDepthFiles(result, arguments.out));
  FORESIGHT_CHECK(WriteChangeChart(result.dense, arguments.out));
  PrintSummary(arguments, result, outside);
  return ExitCode::kDone;
}

}  // namespace

void AddUpsampleCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<UpsampleArguments>();
  CLI::App* command =
      app.add_subcommand("upsample", "Make a dense depth map from an image and sparse samples");
  command->add_option("image,--image", arguments->image, "The image (PNG)")->required();
  command
      ->add_option("samples,--samples", arguments->samples,
                   "CSV with the columns line,beam,u,v,depth_mm")
      ->required();
  command->add_option("--rig", arguments->rig,
                      "Calibration of the head whose camera took the image (YAML)");
  command
      ->add_option("-o,--out", arguments->out,
                   "Folder for depth.pfm (mm), confidence.pfm, mask.png")
      ->capture_default_str();
  AddDepthArguments(*command, arguments->depth);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Upsample(*arguments, context); };
  });
}

}  // namespace foresight
