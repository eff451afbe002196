#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/depth/compare_depth.h"
#include "core/detection/pose_difference.h"
#include "core/mission/mission_file.h"
#include "core/mission/side_result.h"
#include "core/registration/cloud_distance.h"

namespace foresight {

/// The word for what a mission itself keeps of a scan, beside the names of side results.
inline constexpr const char* kOriginalResult = "original";

/// One of two results that are set against each other: a scan, and what was made of it.
struct ComparedResult {
  std::string name;  ///< kOriginalResult, or the side result's
  std::string scan_uuid;
  std::int64_t image = -1;  ///< position in the scan; -1 = the scan has none
  CameraFrame frame;
  SensorRig rig;
  DepthOptions options;
  std::shared_ptr<const RegisteredScan> cloud;
  std::shared_ptr<const DepthResult> depth;  ///< nullptr where the scan has no image
  std::vector<PlacedObject> objects;
  std::vector<std::string> notes;  ///< what whoever reads the numbers must know
};

/// Makes a result of a scan again, by the functions that every program calls.
/// @param review of the mission; nullptr = it has none
/// @param result kOriginalResult, the name of a side result (the newest of that name), its uuid or
/// how that begins
/// @param image position of an image of the scan; none = the one nearest to the middle of its scope
/// Fails with kInvalidInput where there is no such result or image, and as RegisterScan and
/// ComputeDepthInFrame do.
Result<ComparedResult> MakeResultAgain(const MissionFile& mission, const MissionFile* review,
                                       std::int64_t scan_id, const std::string& result,
                                       std::optional<std::int64_t> image,
                                       const RunContext& context);

/// Distances of two clouds, seen from either.
struct CloudDistances {
  CloudDistance from_first;
  CloudDistance from_second;
};

struct ResultComparison {
  std::string first;
  std::string second;
  std::string first_scan;
  std::string second_scan;
  std::int64_t image = -1;               ///< of the depth maps, where they are compared
  std::optional<DepthComparison> depth;  ///< where both are of one image of one scan
  std::optional<CloudDistances> lidar;   ///< of the returns, in robot
  std::optional<CloudDistances>
      masked;  ///< of the masked depth's pixels, every second one, in robot
  std::vector<ObjectPair> objects;
  std::vector<std::string> notes;

  /// Points in robot with the distance to the other result, for who draws them: of the masked depth
  /// where both have one, else the returns.
  struct MeasuredCloud {
    std::vector<Eigen::Vector3f> points;
    std::vector<float> distances_m;
  };
  MeasuredCloud first_cloud;
  MeasuredCloud second_cloud;
};

/// Sets the second against the first: differences are second minus first. Fails with kCancelled.
Result<ResultComparison> CompareResults(const ComparedResult& first, const ComparedResult& second,
                                        const RunContext& context);

/// The pixels that the mask keeps, every second one of every second row, in robot, metres.
std::vector<Eigen::Vector3f> MaskedDepthInRobot(const ComparedResult& result);

/// The comparison as JSON, docs/formats.md: the same text wherever it is made. Ends with a line
/// feed.
std::string ComparisonToJson(const ResultComparison& comparison);

/// The same in lines for people, in mm and deg.
std::vector<std::string> ComparisonInWords(const ResultComparison& comparison);

}  // namespace foresight
