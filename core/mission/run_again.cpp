#include "core/mission/run_again.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "core/depth/depth_option_table.h"
#include "core/detection/detection_json.h"
#include "core/detection/fit_option_table.h"
#include "core/geometry/angles.h"
#include "core/mission/depth_numbers.h"
#include "core/mission/new_records.h"
#include "core/mission/provenance.h"
#include "core/options/option_json.h"
#include "core/registration/register_scan.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson ToJson(const DepthStatistics& statistics) {
  OrderedJson quantiles = OrderedJson::array();
  for (const double depth_m : statistics.depth_quantiles_m)
    quantiles.push_back(std::isfinite(depth_m) ? OrderedJson(depth_m) : OrderedJson(nullptr));
  return {{"valid_pixels", statistics.valid_pixels},
          {"masked_pixels", statistics.masked_pixels},
          {"depth_quantiles_m", quantiles},
          {"largest_confidence", statistics.largest_confidence}};
}

/// Works through one scan; keeps the depth map of one image, which the fits to it share.
class Worker {
 public:
  Worker(const Scan& scan, const RegisteredScan& cloud, const SensorRig& rig,
         const RunAgainSettings& settings)
      : scan_(scan), cloud_(cloud), rig_(rig), settings_(settings) {}

  Status DepthOfImage(std::size_t position, const RunContext& context) {
    const CameraFrame& frame = scan_.frames[position];
    OrderedJson entry = {{"image", position},
                         {"image_deg", DegreesFromRadians(frame.motor_angle_rad)}};
    FORESIGHT_TRY(const DepthResult* depth, Depth(position, entry, context));
    if (depth != nullptr) {
      ++answer_.depth_maps;
      entry["density"] = depth->density;
      entry["below_density_floor"] = depth->BelowDensityFloor();
      FORESIGHT_TRY(DepthRecord record,
                    NewDepthRecord(scan_, *depth, depth->mask, depth->options.mask));
      entry["digest"] = record.digest;
      entry.update(ToJson(record.statistics));
      answer_.depth_records.push_back(std::move(record));
    }
    depths_.push_back(std::move(entry));
    return {};
  }

  Status Fit(const DetectionRecord& record, const RunContext& context) {
    OrderedJson entry = {{"detection", record.uuid}, {"kind", record.kind}};
    const auto found = FitAgain(record, entry, context);
    if (found) {
      ++answer_.fits;
      OrderedJson answer = OrderedJson::parse(DetectionToJson(*found, rig_.robot_from_base));
      answer.erase("seconds");
      entry["answer"] = std::move(answer);
    } else if (found.error().code == ErrorCode::kCancelled) {
      return tl::unexpected(found.error());
    } else {
      const ErrorCode code = found.error().code;
      const bool none = code == ErrorCode::kTooFewPoints || code == ErrorCode::kNoConvergence;
      ++(none ? answer_.fits_without_object : answer_.failures);
      entry["answer"] = nullptr;
      entry["reason"] = found.error().message;
    }
    fits_.push_back(std::move(entry));
    return {};
  }

  RunAgainAnswer Finish() {
    OrderedJson json = {{"format", 1},
                        {"program_version", ProgramVersion()},
                        {"scan_uuid", scan_.uuid},
                        {"rig_id", RigId(rig_)},
                        {"other_rig", settings_.rig.has_value()},
                        {"depth_options", OrderedJson::parse(DepthOptionsToJson(settings_.depth))}};
    if (settings_.source) json["source"] = NameOf(*settings_.source);
    for (const auto& [kind, options] : settings_.fit)
      if (!options.empty())
        json["fit_options"][ToString(kind)] = OrderedJson::parse(
            foresight::ToJson(std::vector<KeyedValue>(options.begin(), options.end())));
    json["depth_maps"] = depths_;
    json["fits"] = fits_;
    answer_.json = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
    return answer_;
  }

 private:
  /// nullptr where it cannot be made, which `entry` says then.
  Result<const DepthResult*> Depth(std::size_t position, OrderedJson& entry,
                                   const RunContext& context) {
    if (depth_of_ == position) return &depth_;
    depth_of_.reset();
    auto depth =
        ComputeDepthInFrame(cloud_, rig_, scan_.frames[position], settings_.depth, context);
    if (!depth && depth.error().code == ErrorCode::kCancelled) return tl::unexpected(depth.error());
    if (!depth) {
      ++answer_.failures;
      entry["reason"] = depth.error().message;
      return nullptr;
    }
    depth_ = std::move(*depth);
    depth_of_ = position;
    return &depth_;
  }

  Result<Detection> FitAgain(const DetectionRecord& record, OrderedJson& entry,
                             const RunContext& context) {
    FORESIGHT_TRY(const Provenance provenance,
                  ProvenanceFromJson(record.provenance_json, "detection " + record.uuid));
    if (!provenance.fit || !provenance.roi)
      return Fail(ErrorCode::kBadData, "detection {}: its provenance names no fit", record.uuid);
    NamedSource source;
    if (settings_.source) {
      source = *settings_.source;
    } else {
      FORESIGHT_TRY(source, FitSourceFromName(provenance.source));
    }
    const DepthResult* depth = nullptr;
    if (source.source != FitSource::kRaw) {
      source.method = settings_.depth.method;
      FORESIGHT_TRY(const std::size_t position, ImageOf(provenance));
      entry["image"] = position;
      FORESIGHT_TRY(depth, Depth(position, entry, context.Part(0.0, 0.5)));
      if (depth == nullptr)
        return Fail(ErrorCode::kInvalidInput, "there is no depth map of image {}", position);
    }
    entry["source"] = NameOf(source);
    FitOptions options = *provenance.fit;
    FORESIGHT_CHECK(Change(options));
    FORESIGHT_TRY(Detection found, FitInScan({rig_, cloud_, scan_.frames, depth}, source.source,
                                             *provenance.roi, options, context.Part(0.5, 1.0)));
    FORESIGHT_TRY(const Provenance made,
                  ProvenanceOfFit(scan_, source.source, depth, settings_.depth.mask, options,
                                  *provenance.roi));
    answer_.detection_records.push_back(NewDetectionRecord(scan_, found, made));
    return found;
  }

  /// Sets the options of the fit that the settings name.
  Status Change(FitOptions& options) const {
    const ObjectKind kind = ObjectKindOf(options);
    const auto changed = settings_.fit.find(kind);
    if (changed == settings_.fit.end()) return {};
    for (const auto& [key, value] : changed->second) {
      FORESIGHT_CHECK(CheckFitOption(kind, key, value));
      FORESIGHT_CHECK(SetOption(*FindOption(FitOptionTable(kind), key), options, value));
    }
    return std::visit([](const auto& held) { return held.Check(); }, options);
  }

  /// The image that the record was fitted on; where it was fitted to returns, the nearest one to
  /// the middle of the scope.
  Result<std::size_t> ImageOf(const Provenance& provenance) const {
    const auto count = static_cast<std::int64_t>(scan_.frames.size());
    if (provenance.image_position >= 0 && provenance.image_position < count)
      return static_cast<std::size_t>(provenance.image_position);
    const CameraFrame* middle =
        NearestFrame(scan_, 0.5 * (scan_.plan.from_rad + scan_.plan.to_rad));
    if (middle == nullptr)
      return Fail(ErrorCode::kInvalidInput, "the scan has no image for a depth map");
    for (std::size_t i = 0; i < scan_.frames.size(); ++i)
      if (&scan_.frames[i] == middle) return i;
    return 0;
  }

  const Scan& scan_;
  const RegisteredScan& cloud_;
  const SensorRig& rig_;
  const RunAgainSettings& settings_;
  std::optional<std::size_t> depth_of_;
  DepthResult depth_;
  OrderedJson depths_ = OrderedJson::array();
  OrderedJson fits_ = OrderedJson::array();
  RunAgainAnswer answer_;
};

}  // namespace

Status CheckFitOption(ObjectKind kind, const std::string& key, const OptionValue& value) {
  const Option<FitOptions>* option = FindOption(FitOptionTable(kind), key);
  if (option == nullptr)
    return Fail(ErrorCode::kInvalidOptions, "a {}'s fit has no option '{}'", ToString(kind), key);
  return CheckOption(option->info, value);
}

Result<RunAgainAnswer> RunAgain(const Scan& scan, const std::vector<DetectionRecord>& records,
                                const RunAgainSettings& settings, const RunContext& context) {
  Scan with_rig = scan;
  if (settings.rig) {  // as a file keeps it, so that what is made from the file is the same
    FORESIGHT_TRY(with_rig.rig, SensorRigFromYaml(SensorRigToYaml(*settings.rig), "rig"));
  }
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(with_rig, context.Part(0.0, 0.1)));
  Worker worker(with_rig, cloud, with_rig.rig, settings);
  std::vector<const DetectionRecord*> wanted;
  for (const DetectionRecord& record : records)
    if (record.scan_uuid == scan.uuid && !record.deleted) wanted.push_back(&record);
  std::sort(wanted.begin(), wanted.end(), [](const DetectionRecord* a, const DetectionRecord* b) {
    return std::tie(a->utc_ns, a->uuid) < std::tie(b->utc_ns, b->uuid);
  });
  const auto all = static_cast<double>(with_rig.frames.size() + wanted.size());
  double done = 0.0;
  const auto part = [&] {
    const RunContext slice = context.Part(0.1 + 0.9 * done / all, 0.1 + 0.9 * (done + 1.0) / all);
    done += 1.0;
    return slice;
  };
  for (std::size_t position = 0; position < with_rig.frames.size(); ++position)
    FORESIGHT_CHECK(worker.DepthOfImage(position, part()));
  for (const DetectionRecord* record : wanted) FORESIGHT_CHECK(worker.Fit(*record, part()));
  return worker.Finish();
}

}  // namespace foresight
