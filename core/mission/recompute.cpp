#include "core/mission/recompute.h"

#include <algorithm>

#include "core/detection/detection_json.h"
#include "core/mission/depth_numbers.h"
#include "core/mission/json_differences.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

void AddDifference(Recomputed& answer, const std::string& text) {
  if (answer.differences.size() < Recomputed::kMostDifferences) answer.differences.push_back(text);
  answer.outcome = Recomputed::Outcome::kDifferent;
}

Recomputed NotPossible(const Error& error) {
  return {Recomputed::Outcome::kNotPossible, {error.message}};
}

/// A cancelled or unreadable record ends everything; any other failure is the record's own answer.
bool EndsAll(const Error& error) {
  return error.code == ErrorCode::kCancelled || error.code == ErrorCode::kIo;
}

}  // namespace

const char* ToString(Recomputed::Outcome outcome) {
  switch (outcome) {
    case Recomputed::Outcome::kSame:
      return "same";
    case Recomputed::Outcome::kDifferent:
      return "different";
    case Recomputed::Outcome::kNotPossible:
      break;
  }
  return "not possible";
}

Status Recomputer::OpenScan(const std::string& uuid, const std::string& rig_id,
                            const RunContext& context) {
  if (bench_.scan() && bench_.scan()->uuid == uuid && RigId(bench_.scan()->rig) == rig_id)
    return {};
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, scans_.ListScans());
  const auto at = std::find_if(scans.begin(), scans.end(),
                               [&](const ScanSummary& scan) { return scan.uuid == uuid; });
  if (at == scans.end())
    return Fail(ErrorCode::kInvalidInput, "{} does not hold the scan {}", scans_.path().string(),
                uuid);
  FORESIGHT_TRY(Scan scan, scans_.LoadScan(at->id));
  if (RigId(scan.rig) != rig_id) {
    FORESIGHT_TRY(std::optional<SensorRig> rig, rigs_.FindRig(rig_id));
    if (rig) scan.rig = std::move(*rig);
  }
  return bench_.Take(std::make_shared<const Scan>(std::move(scan)), context);
}

Result<Recomputed> Recomputer::RemakeDetection(const DetectionRecord& record,
                                               const RunContext& context) {
  const auto made_again = [&]() -> Result<Recomputed> {
    if (record.provenance_json.empty())
      return Fail(ErrorCode::kInvalidInput, "it has no provenance: an earlier program wrote it");
    FORESIGHT_TRY(const Provenance provenance,
                  ProvenanceFromJson(record.provenance_json, "detection " + record.uuid));
    FORESIGHT_CHECK(OpenScan(record.scan_uuid, provenance.rig_id, context.Part(0.0, 0.2)));
    FORESIGHT_TRY(const Detection found, bench_.Fit(provenance, context.Part(0.2, 1.0)));
    Recomputed answer;
    const std::string is = DetectionToJson(found, bench_.scan()->rig.robot_from_base);
    for (const std::string& difference : JsonDifferences(record.json, is, {"seconds"}))
      AddDifference(answer, difference);
    return answer;
  }();
  if (!made_again && !EndsAll(made_again.error())) return NotPossible(made_again.error());
  return made_again;
}

Result<Recomputed> Recomputer::RemakeDepth(const DepthRecord& record, const RunContext& context) {
  const auto made_again = [&]() -> Result<Recomputed> {
    FORESIGHT_TRY(const Provenance provenance,
                  ProvenanceFromJson(record.provenance_json, "depth map " + record.uuid));
    FORESIGHT_CHECK(OpenScan(record.scan_uuid, provenance.rig_id, context.Part(0.0, 0.2)));
    FORESIGHT_TRY(const DepthResult* depth, bench_.Depth(provenance, context.Part(0.2, 1.0)));
    Recomputed answer;
    const std::string digest = DigestOf(depth->dense, depth->mask);
    if (digest == record.digest) return answer;
    const DepthStatistics was = record.statistics;
    const DepthStatistics is = StatisticsOf(depth->dense, depth->mask);
    AddDifference(answer, fmt::format("digest: was {}, is {}", record.digest, digest));
    AddDifference(
        answer, fmt::format("pixels with depth: was {}, is {}; masked: was {}, is {}; median "
                            "depth in metres: was {}, is {}",
                            was.valid_pixels, is.valid_pixels, was.masked_pixels, is.masked_pixels,
                            was.depth_quantiles_m[2], is.depth_quantiles_m[2]));
    return answer;
  }();
  if (!made_again && !EndsAll(made_again.error())) return NotPossible(made_again.error());
  return made_again;
}

}  // namespace foresight
