#include "app/common/record_scan.h"

#include "app/common/execute_scan.h"
#include "app/common/output.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

void PrintScan(const std::string& mission_file, const ScanSummary& scan,
               const ExecutedScan& executed, int planned_lines, bool json) {
  if (json)
    PrintJson({{"mission", mission_file},
               {"scan", scan.id},
               {"uuid", scan.uuid},
               {"source", scan.source},
               {"state", ToString(scan.state)},
               {"reason", scan.reason},
               {"lines", scan.lines},
               {"planned_lines", planned_lines},
               {"frames", scan.images},
               {"seconds", executed.seconds},
               {"cpu_ratio", executed.cpu_fraction}});
  else
    PrintLine(fmt::format("{}: scan {} {}, {} lines, {} image{}{}{}", mission_file, scan.id,
                          ToString(scan.state), scan.lines, scan.images,
                          scan.images == 1 ? "" : "s", scan.reason.empty() ? "" : ": ",
                          scan.reason));
}

}  // namespace

std::string ToText(const ScanPrediction& p) {
  return fmt::format(
      "{:.1f} s, {} lines, {:.1f} % of the pixels measured, sigma_s {:.1f} px, exposure {:.2f} ms, "
      "blur {:.2f} px, {:.1f} MB; {:.0f} % up to {:.1f} deg/s",
      p.duration_s, p.lines, 100.0 * p.density, p.sigma_spatial_px, 1e3 * p.exposure_s, p.blur_px,
      1e-6 * static_cast<double>(p.bytes), 100.0 * ScanPrediction::kMinDensity,
      DegreesFromRadians(p.fastest_speed_rad_s));
}

Result<ExitCode> RecordScan(SensorHead& head, const ScanPlan& plan, const std::string& mission_file,
                            bool json, const RunContext& context) {
  FORESIGHT_TRY(const auto prediction, PredictScan(plan, head.Rig(), head.Motion()));
  PrintNote("{}: {}", head.Describe(), ToText(prediction));
  const RemoveUnlessUsed guard(mission_file);  // outlives the mission, which closes the file
  FORESIGHT_TRY(const auto mission, OpenOrCreateMission(mission_file));
  FORESIGHT_TRY(const ExecutedScan executed, ExecuteScan(head, plan, mission, context));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  FORESIGHT_CHECK(mission->Close());
  for (const ScanSummary& scan : scans) {
    if (scan.id != executed.id) continue;
    PrintScan(mission_file, scan, executed, prediction.lines, json);
    return scan.state == ScanState::kComplete ? ExitCode::kDone : ExitCode::kNegative;
  }
  return Fail(ErrorCode::kBadData, "{}: scan {} is missing after it was recorded", mission_file,
              executed.id);
}

}  // namespace foresight
