#include "app/ctl/evaluate_hold_out.h"

#include <filesystem>

#include "app/ctl/command.h"
#include "core/depth/depth_method.h"
#include "core/mission/mission_file.h"
#include "core/registration/register_scan.h"
#include "core/selfcheck/compare_held_out.h"

namespace foresight {
namespace {

struct Row {
  std::string mission;
  std::int64_t scan = 0;
  MethodOnHeldOut score;
};

nlohmann::ordered_json ToJson(const HeldOutErrors& errors, int beams) {
  return {{"q50_mm", FiniteOrNull(1000.0 * errors.q50_m)},
          {"q80_mm", FiniteOrNull(1000.0 * errors.q80_m)},
          {"q95_mm", FiniteOrNull(1000.0 * errors.q95_m)},
          {"right", FiniteOrNull(errors.right)},
          {"coverage", static_cast<double>(errors.beams) / beams}};
}

std::string Columns(const HeldOutErrors& errors, int beams) {
  return fmt::format("{:>8.0f}{:>8.0f}{:>7.3f}{:>7.3f}", 1000.0 * errors.q80_m,
                     1000.0 * errors.q95_m, errors.right,
                     static_cast<double>(errors.beams) / beams);
}

void Print(const std::vector<Row>& rows, int keep_one_in, bool json) {
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const Row& row : rows)
      list.push_back({{"mission", row.mission},
                      {"scan", row.scan},
                      {"method", InfoOf(row.score.method).name},
                      {"kept_one_line_in", keep_one_in},
                      {"beams", row.score.beams},
                      {"without_mask", ToJson(row.score.without_mask, row.score.beams)},
                      {"own_mask", ToJson(row.score.own_mask, row.score.beams)},
                      {"our_mask", ToJson(row.score.our_mask, row.score.beams)},
                      {"seconds", row.score.seconds}});
    PrintJson(list);
    return;
  }
  const std::string columns =
      fmt::format("{:>8}{:>8}{:>7}{:>7}", "80 mm", "95 mm", "right", "cover");
  PrintLine(fmt::format("{:<28}{:>8}   {:<30}   {:<30}   {:<30}\n{:<28}{:>8}   {}   {}   {}",
                        "map of 1 line in " + std::to_string(keep_one_in), "", "not masked",
                        "own mask", "Foresight's mask", "scan, method", "beams", columns, columns,
                        columns));
  for (const Row& row : rows)
    PrintLine(
        fmt::format("{:<28}{:>8}   {}   {}   {}",
                    fmt::format("{} {} {}", std::filesystem::path(row.mission).stem().string(),
                                row.scan, InfoOf(row.score.method).name),
                    row.score.beams, Columns(row.score.without_mask, row.score.beams),
                    Columns(row.score.own_mask, row.score.beams),
                    Columns(row.score.our_mask, row.score.beams)));
}

Status AddScan(const std::string& path, const MissionFile& mission, const ScanSummary& summary,
               const std::vector<DepthMethod>& methods, int keep_one_in, std::vector<Row>& rows,
               const RunContext& context) {
  FORESIGHT_TRY(const Scan scan, mission.LoadScan(summary.id));
  const CameraFrame* frame = NearestFrame(scan, 0.5 * (scan.plan.from_rad + scan.plan.to_rad));
  if (frame == nullptr) {
    PrintNote("{}: scan {} has no image, so there is no depth map to evaluate", path, summary.id);
    return {};
  }
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(scan, context));
  FORESIGHT_TRY(const std::vector<MethodOnHeldOut> scores,
                CompareOnHeldOut(cloud, scan.rig, *frame, methods, keep_one_in, context)
                    .map_error(Of(fmt::format("{}: scan {}", path, summary.id))));
  for (const MethodOnHeldOut& score : scores) rows.push_back({path, summary.id, score});
  return {};
}

}  // namespace

Result<ExitCode> EvaluateHoldOut(const std::vector<std::string>& missions,
                                 const std::vector<DepthMethod>& methods, int keep_one_in,
                                 bool json, const RunContext& context) {
  std::vector<Row> rows;
  for (const std::string& path : missions) {
    FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
    for (const ScanSummary& scan : scans)
      FORESIGHT_CHECK(AddScan(path, *mission, scan, methods, keep_one_in, rows, context));
  }
  if (rows.empty())
    return Fail(ErrorCode::kInvalidInput, "none of the missions has a scan with an image");
  Print(rows, keep_one_in, json);
  return ExitCode::kDone;
}

}  // namespace foresight
