#include "core/mission/recompute.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/depth/depth_option_table.h"
#include "core/detection/detection_json.h"
#include "core/io/json_reader.h"
#include "core/mission/depth_numbers.h"
#include "core/registration/register_scan.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using Json = nlohmann::json;

void AddDifference(Recomputed& answer, const std::string& text) {
  if (answer.differences.size() < Recomputed::kMostDifferences) answer.differences.push_back(text);
  answer.outcome = Recomputed::Outcome::kDifferent;
}

Recomputed NotPossible(const Error& error) {
  return {Recomputed::Outcome::kNotPossible, {error.message}};
}

/// Leaf by leaf, under the path that leads there.
void Compare(const Json& was, const Json& is, const std::string& path, Recomputed& answer) {
  if (was == is) return;
  if (was.is_structured() && was.type() == is.type()) {
    const Json &old_leaves = was.flatten(), &new_leaves = is.flatten();
    for (const auto& [at, value] : old_leaves.items()) {
      if (!new_leaves.contains(at))
        AddDifference(answer, fmt::format("{}{}: was {}, is gone", path, at, value.dump()));
      else if (new_leaves.at(at) != value)
        AddDifference(answer, fmt::format("{}{}: was {}, is {}", path, at, value.dump(),
                                          new_leaves.at(at).dump()));
    }
    for (const auto& [at, value] : new_leaves.items())
      if (!old_leaves.contains(at))
        AddDifference(answer, fmt::format("{}{}: is new, {}", path, at, value.dump()));
    return;
  }
  AddDifference(answer, fmt::format("{}: was {}, is {}", path, was.dump(), is.dump()));
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

Status Recomputer::OpenScan(const std::string& uuid, const RunContext& context) {
  if (opened_.uuid == uuid) return {};
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, scans_.ListScans());
  const auto at = std::find_if(scans.begin(), scans.end(),
                               [&](const ScanSummary& scan) { return scan.uuid == uuid; });
  if (at == scans.end())
    return Fail(ErrorCode::kInvalidInput, "{} does not hold the scan {}", scans_.path().string(),
                uuid);
  opened_ = {};
  FORESIGHT_TRY(opened_.scan, scans_.LoadScan(at->id));
  FORESIGHT_TRY(opened_.cloud, RegisterScan(opened_.scan, context));
  opened_.uuid = uuid;
  return {};
}

Status Recomputer::Prepare(const Provenance& provenance, const RunContext& context) {
  const std::string rig_id = RigId(opened_.scan.rig);
  if (rig_id != provenance.rig_id)
    return Fail(ErrorCode::kInvalidInput, "made with the rig {}, but the scan has the rig {}",
                provenance.rig_id, rig_id);
  if (!provenance.depth) return {};
  const auto& frames = opened_.scan.frames;
  if (provenance.image_position < 0 ||
      provenance.image_position >= static_cast<std::int64_t>(frames.size()))
    return Fail(ErrorCode::kInvalidInput, "made on image {}, but the scan has {} images",
                provenance.image_position, frames.size());
  const std::string options = DepthOptionsToJson(*provenance.depth);
  if (opened_.depth_image == provenance.image_position && opened_.depth_options == options)
    return {};
  const CameraFrame& frame = frames[static_cast<std::size_t>(provenance.image_position)];
  opened_.depth_image = -1;
  FORESIGHT_TRY(opened_.depth, ComputeDepthInFrame(opened_.cloud, opened_.scan.rig, frame,
                                                   *provenance.depth, context));
  opened_.depth_image = provenance.image_position;
  opened_.depth_options = options;
  return {};
}

Result<Recomputed> Recomputer::RemakeDetection(const DetectionRecord& record,
                                               const RunContext& context) {
  const auto made_again = [&]() -> Result<Recomputed> {
    if (record.provenance_json.empty())
      return Fail(ErrorCode::kInvalidInput, "it has no provenance: an earlier program wrote it");
    FORESIGHT_TRY(const Provenance provenance,
                  ProvenanceFromJson(record.provenance_json, "detection " + record.uuid));
    if (!provenance.fit || !provenance.roi)
      return Fail(ErrorCode::kBadData, "its provenance names no fit");
    FORESIGHT_TRY(const NamedSource source, FitSourceFromName(provenance.source));
    FORESIGHT_CHECK(OpenScan(record.scan_uuid, context.Part(0.0, 0.2)));
    FORESIGHT_CHECK(Prepare(provenance, context.Part(0.2, 0.6)));
    RegisteredScan cloud = opened_.cloud;
    if (provenance.part) {
      FORESIGHT_TRY(const Scan part, TakePart(opened_.scan, *provenance.part));
      FORESIGHT_TRY(cloud, RegisterScan(part, context.Part(0.55, 0.6)));
    }
    const ProcessedScan processed{opened_.scan.rig, cloud,
                                  provenance.depth ? &opened_.depth : nullptr};
    FORESIGHT_TRY(const Detection found, FitInScan(processed, source.source, *provenance.roi,
                                                   *provenance.fit, context.Part(0.6, 1.0)));
    Json was = ParseJson(record.json);
    Json is = ParseJson(DetectionToJson(found, opened_.scan.rig.robot_from_base));
    for (Json* json : {&was, &is}) json->erase("seconds");
    Recomputed answer;
    Compare(was, is, "", answer);
    return answer;
  }();
  if (!made_again && !EndsAll(made_again.error())) return NotPossible(made_again.error());
  return made_again;
}

Result<Recomputed> Recomputer::RemakeDepth(const DepthRecord& record, const RunContext& context) {
  const auto made_again = [&]() -> Result<Recomputed> {
    FORESIGHT_TRY(const Provenance provenance,
                  ProvenanceFromJson(record.provenance_json, "depth map " + record.uuid));
    if (!provenance.depth) return Fail(ErrorCode::kBadData, "its provenance names no depth map");
    FORESIGHT_CHECK(OpenScan(record.scan_uuid, context.Part(0.0, 0.2)));
    FORESIGHT_CHECK(Prepare(provenance, context.Part(0.2, 1.0)));
    Recomputed answer;
    const std::string digest = DigestOf(opened_.depth.dense, opened_.depth.mask);
    if (digest == record.digest) return answer;
    const DepthStatistics was = record.statistics;
    const DepthStatistics is = StatisticsOf(opened_.depth.dense, opened_.depth.mask);
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
