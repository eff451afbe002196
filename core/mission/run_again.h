#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/depth/pipeline.h"
#include "core/detection/fit_in_scan.h"
#include "core/mission/mission_records.h"
#include "core/options/option.h"
#include "core/sensor/scan.h"

namespace foresight {

/// What a recorded scan is worked through with, in place of what was in force at the time.
struct RunAgainSettings {
  DepthOptions depth;                 ///< of every depth map
  std::optional<SensorRig> rig;       ///< none = each scan's own
  std::optional<NamedSource> source;  ///< of every fit; none = what each record was fitted to
  /// Options of fits by their key in FitOptionTable; those that are not named are each record's.
  std::map<ObjectKind, std::map<std::string, OptionValue>> fit;
};

/// What came out of one scan.
struct RunAgainAnswer {
  std::string json;  ///< docs/formats.md, "Results of mission run"; ends with a line feed
  int depth_maps = 0;
  int fits = 0;  ///< that found their object
  int fits_without_object = 0;
  int failures = 0;  ///< depth maps or fits that could not be made; the JSON has the reasons
  /// What was made, as a mission keeps it: without uuids, and of this moment and operator.
  std::vector<DepthRecord> depth_records;
  std::vector<DetectionRecord> detection_records;
};

/// Whether an option is one of the kind's, and its value one that it may have. Fails with
/// kInvalidOptions, naming the key.
Status CheckFitOption(ObjectKind kind, const std::string& key, const OptionValue& value);

/// Makes a depth map of every image of the scan, and fits again what `records` found in it, in the
/// same regions and with the same fit options. A record that names no region is told as a failure.
/// The JSON depends on nothing but the scan, the records, the settings and the program: no time, no
/// path, no number of threads. Fails with kCancelled, and as RegisterScan does.
Result<RunAgainAnswer> RunAgain(const Scan& scan, const std::vector<DetectionRecord>& records,
                                const RunAgainSettings& settings, const RunContext& context);

}  // namespace foresight
