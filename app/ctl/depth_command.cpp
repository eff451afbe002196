#include <memory>

#include "app/ctl/change_chart.h"
#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "app/ctl/open_scan.h"
#include "core/depth/imported_samples.h"
#include "core/geometry/angles.h"
#include "core/io/png.h"
#include "core/mission/new_records.h"
#include "core/registration/register_scan.h"

namespace foresight {
namespace {

struct DepthCommandArguments {
  ScanArguments scan;
  DepthArguments depth;
  std::string out = ".";
  bool save = false;
  bool json = false;
};

/// How the map is made again, into the mission.
Status Save(const DepthCommandArguments& arguments, const OpenedScan& opened,
            const DepthResult& result) {
  FORESIGHT_TRY(DepthRecord record,
                NewDepthRecord(opened.scan, result, result.mask, result.options.mask));
  record.scan_id = opened.id;
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::Open(arguments.scan.mission));
  FORESIGHT_CHECK(mission->AddDepth(record));
  return mission->Close();
}

Result<ExitCode> Depth(const DepthCommandArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const DepthOptions options, DepthOptionsFrom(arguments.depth));
  FORESIGHT_TRY(const OpenedScan opened, OpenScan(arguments.scan));
  FORESIGHT_TRY(const RegisteredScan registered, RegisterScan(opened.scan, context.Part(0.0, 0.1)));
  FORESIGHT_TRY(const DepthResult result,
                ComputeDepthInFrame(registered, opened.scan.rig, opened.frame, options,
                                    context.Part(0.1, 1.0)));
  WarnOfLowDensity(result);
  if (arguments.save) FORESIGHT_CHECK(Save(arguments, opened, result));
  FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
  FORESIGHT_CHECK(WriteDepthFiles(result, arguments.out));
  FORESIGHT_CHECK(WriteChangeChart(result.dense, arguments.out));
  const std::filesystem::path folder(arguments.out);
  FORESIGHT_CHECK(WritePng(folder / "image.png", opened.frame.image, PngContent::kCapture));
  FORESIGHT_CHECK(WriteCsvSamples(folder / "samples.csv", ExportSamples(result.samples)));
  FORESIGHT_CHECK(SaveSensorRig(opened.scan.rig, folder / "rig.yaml"));
  const std::size_t count = result.samples.samples.size();
  const double image_deg = DegreesFromRadians(opened.frame.motor_angle_rad);
  if (arguments.json)
    PrintJson({{"scan", opened.id},
               {"scan_state", ToString(opened.scan.state)},
               {"scan_reason", opened.scan.reason},
               {"image_deg", image_deg},
               {"samples", count},
               {"rejected", count - result.samples.KeptCount()},
               {"density", result.density},
               {"below_density_floor", result.BelowDensityFloor()},
               {"sigma_spatial_px", result.dense.sigma_spatial_px},
               {"mean_change_mm", ChangeJson(result.dense)},
               {"seconds", result.seconds},
               {"out", arguments.out}});
  else
    PrintLine(fmt::format(
        "{}: depth.pfm, confidence.pfm, mask.png, image.png, samples.csv, rig.yaml of scan {} at "
        "{:.1f} deg; {} samples, {} rejected, {:.2f} s",
        arguments.out, opened.id, image_deg, count, count - result.samples.KeptCount(),
        result.seconds));
  return ExitCode::kDone;
}

}  // namespace

void AddDepthCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<DepthCommandArguments>();
  CLI::App* command = app.add_subcommand("depth", "Make the masked dense depth map of a scan");
  AddScanArguments(*command, arguments->scan);
  AddDepthArguments(*command, arguments->depth);
  command->add_option("-o,--out", arguments->out, "Folder for the results")->capture_default_str();
  command->add_flag("--save", arguments->save,
                    "Note in the mission file how the depth map was made, and its checksum");
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Depth(*arguments, context); };
  });
}

}  // namespace foresight
