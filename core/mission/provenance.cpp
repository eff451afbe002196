#include "core/mission/provenance.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "core/depth/depth_method.h"
#include "core/depth/depth_option_table.h"
#include "core/detection/detection_json.h"
#include "core/detection/fit_option_table.h"
#include "core/io/json_reader.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

Result<std::int64_t> PositionOf(const Scan& scan, const DepthResult& depth) {
  const auto at =
      std::find_if(scan.frames.begin(), scan.frames.end(),
                   [&](const CameraFrame& frame) { return frame.seq == depth.image_seq; });
  if (at == scan.frames.end())
    return Fail(ErrorCode::kInvalidInput, "the depth map's image {} is not in scan {}",
                depth.image_seq, scan.uuid);
  return at - scan.frames.begin();
}

Provenance ProvenanceOf(const Scan& scan) {
  Provenance provenance;
  provenance.program_version = ProgramVersion();
  provenance.rig_id = RigId(scan.rig);
  return provenance;
}

Status AddDepth(const Scan& scan, const DepthResult& depth, const ConfidenceMaskOptions& mask,
                Provenance& provenance) {
  FORESIGHT_TRY(provenance.image_position, PositionOf(scan, depth));
  provenance.depth = depth.options;
  provenance.depth->mask = mask;
  return {};
}

OrderedJson ToJson(const ScanPart& part) {
  return {{"lines", part.lines}, {"of_lines", part.of_lines}, {"seqs", part.seqs}};
}

Result<ScanPart> PartFrom(const nlohmann::json& value) {
  ScanPart part;
  value.at("lines").get_to(part.lines);
  value.at("of_lines").get_to(part.of_lines);
  value.at("seqs").get_to(part.seqs);
  std::int64_t last = -1;
  for (const auto& [first, end] : part.seqs) {
    if (first <= last || end < first)
      return Fail(ErrorCode::kBadData, "part: seqs: [{}, {}] is out of order", first, end);
    last = end;
  }
  return part;
}

Provenance ProvenanceFrom(const nlohmann::json& value) {
  Provenance provenance;
  value.at("program_version").get_to(provenance.program_version);
  value.at("rig_id").get_to(provenance.rig_id);
  value.at("image_position").get_to(provenance.image_position);
  value.at("source").get_to(provenance.source);
  const auto read = [&value](const char* key, const auto& from) {
    if (value.at(key).is_null()) return;
    const Status done = from(value.at(key));
    if (!done) throw std::invalid_argument(done.error().message);
  };
  read("depth_options", [&](const nlohmann::json& options) -> Status {
    FORESIGHT_TRY(provenance.depth, DepthOptionsFromJson(options.dump()));
    return {};
  });
  read("fit_options", [&](const nlohmann::json& options) -> Status {
    FORESIGHT_TRY(const ObjectKind kind, ObjectKindFromString(value.at("object")));
    FORESIGHT_TRY(provenance.fit, FitOptionsFromJson(kind, options.dump()));
    return {};
  });
  read("roi", [&](const nlohmann::json& roi) -> Status {
    FORESIGHT_TRY(provenance.roi, RoiFromJson(roi.dump()));
    return {};
  });
  if (value.contains("part"))
    read("part", [&](const nlohmann::json& part) -> Status {
      FORESIGHT_TRY(provenance.part, PartFrom(part));
      return {};
    });
  return provenance;
}

}  // namespace

Result<Provenance> ProvenanceOfFit(const Scan& scan, FitSource source, const DepthResult* depth,
                                   const ConfidenceMaskOptions& mask, const FitOptions& options,
                                   const Roi& roi) {
  Provenance provenance = ProvenanceOf(scan);
  NamedSource named{source, {}};
  if (source != FitSource::kRaw) {
    FORESIGHT_EXPECTS(depth != nullptr, "a fit to a depth map has one");
    FORESIGHT_CHECK(AddDepth(scan, *depth, mask, provenance));
    named.method = depth->options.method;
  }
  provenance.source = NameOf(named);
  provenance.fit = options;
  provenance.roi = roi;
  return provenance;
}

Result<Provenance> ProvenanceOfDepth(const Scan& scan, const DepthResult& depth,
                                     const ConfidenceMaskOptions& mask) {
  Provenance provenance = ProvenanceOf(scan);
  FORESIGHT_CHECK(AddDepth(scan, depth, mask, provenance));
  provenance.source = InfoOf(depth.options.method).name;
  return provenance;
}

std::string ProvenanceToJson(const Provenance& provenance) {
  OrderedJson json = {{"program_version", provenance.program_version},
                      {"rig_id", provenance.rig_id},
                      {"image_position", provenance.image_position},
                      {"source", provenance.source},
                      {"depth_options", nullptr},
                      {"object", nullptr},
                      {"fit_options", nullptr},
                      {"roi", nullptr}};
  if (provenance.depth)
    json["depth_options"] = OrderedJson::parse(DepthOptionsToJson(*provenance.depth));
  if (provenance.fit) {
    json["object"] = ToString(ObjectKindOf(*provenance.fit));
    json["fit_options"] = OrderedJson::parse(FitOptionsToJson(*provenance.fit));
  }
  if (provenance.roi) json["roi"] = OrderedJson::parse(RoiToJson(*provenance.roi));
  if (provenance.part) json["part"] = ToJson(*provenance.part);
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

Result<Provenance> ProvenanceFromJson(const std::string& json, const std::string& source) {
  try {
    return ProvenanceFrom(ParseJson(json));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "{}: provenance: {}", source, failure.what());
  }
}

}  // namespace foresight
