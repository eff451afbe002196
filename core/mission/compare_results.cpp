#include "core/mission/compare_results.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "core/detection/detection_json.h"
#include "core/geometry/angles.h"
#include "core/io/json_numbers.h"
#include "core/mission/depth_numbers.h"
#include "core/registration/returns_in_robot.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

using OrderedJson = nlohmann::ordered_json;

Result<SideResult> FindSideResult(const MissionFile& mission, const MissionFile* review,
                                  const std::string& scan_uuid, const std::string& wanted) {
  FORESIGHT_TRY(const std::vector<SideResult> all, SideResultsOf(mission, review, scan_uuid));
  for (auto result = all.rbegin(); result != all.rend(); ++result)
    if (result->name == wanted || result->uuid == wanted) return *result;
  constexpr std::size_t kFewestDigits = 4;
  for (auto result = all.rbegin(); result != all.rend(); ++result)
    if (wanted.size() >= kFewestDigits && result->uuid.starts_with(wanted)) return *result;
  std::string names = kOriginalResult;
  for (const SideResult& result : all) names += ", " + result.name;
  return Fail(ErrorCode::kInvalidInput, "{}: the scan has no result '{}'; there are: {}",
              mission.path().string(), wanted, names);
}

Result<std::int64_t> ChooseImage(const Scan& scan, std::optional<std::int64_t> wanted) {
  const auto count = static_cast<std::int64_t>(scan.frames.size());
  if (wanted && (*wanted < 0 || *wanted >= count))
    return Fail(ErrorCode::kInvalidInput, "scan {} has {} images: there is no image {}", scan.uuid,
                count, *wanted);
  if (wanted) return *wanted;
  const CameraFrame* middle = NearestFrame(scan, 0.5 * (scan.plan.from_rad + scan.plan.to_rad));
  for (std::int64_t i = 0; i < count; ++i)
    if (&scan.frames[static_cast<std::size_t>(i)] == middle) return i;
  return -1;
}

Status PlaceObjects(const std::vector<DetectionRecord>& records, ComparedResult& result) {
  for (const DetectionRecord& record : records) {
    if (record.deleted) continue;
    const auto detection = DetectionFromJson(record.json);
    if (!detection)
      return Fail(ErrorCode::kBadData, "detection {}: {}", record.uuid, detection.error().message);
    for (PlacedObject& object :
         PlacedObjectsOf(*detection, record.uuid, result.rig.robot_from_base))
      result.objects.push_back(std::move(object));
  }
  return {};
}

/// The records of a side result that are of one kind.
template <class Record>
std::vector<Record> Named(const std::vector<Record>& records,
                          const std::vector<std::string>& uuids) {
  std::vector<Record> named;
  for (const Record& record : records)
    if (std::count(uuids.begin(), uuids.end(), record.uuid) > 0) named.push_back(record);
  return named;
}

Result<std::vector<DepthRecord>> DepthsOf(const MissionFile& mission, const MissionFile* review,
                                          const std::vector<std::string>& uuids) {
  std::vector<DepthRecord> depths;
  for (const MissionFile* file : {&mission, review}) {
    if (file == nullptr) continue;
    FORESIGHT_TRY(const std::vector<DepthRecord> all, file->ListDepths());
    for (DepthRecord& record : Named(all, uuids)) depths.push_back(std::move(record));
  }
  return depths;
}

Result<std::vector<DetectionRecord>> FitsOf(const MissionFile& mission, const MissionFile* review,
                                            const std::vector<std::string>& uuids) {
  std::vector<DetectionRecord> fits;
  for (const MissionFile* file : {&mission, review}) {
    if (file == nullptr) continue;
    FORESIGHT_TRY(const std::vector<DetectionRecord> all, file->ListDetections());
    for (DetectionRecord& record : Named(all, uuids)) fits.push_back(std::move(record));
  }
  return fits;
}

/// The rig of a side result, where it is not the scan's own.
Result<SensorRig> RigOf(const SideResult& side, const MissionFile& mission,
                        const MissionFile* review) {
  for (const MissionFile* file : {review, &mission}) {
    if (file == nullptr) continue;
    FORESIGHT_TRY(const std::optional<SensorRig> rig, file->FindRig(side.rig_id));
    if (rig) return *rig;
  }
  return Fail(ErrorCode::kBadData, "side result '{}': its rig {} is not in the file", side.name,
              side.rig_id);
}

/// Of two clouds, whose points are taken.
Result<CloudDistances> Distances(std::vector<Eigen::Vector3f> first,
                                 std::vector<Eigen::Vector3f> second, ResultComparison& comparison,
                                 const RunContext& context) {
  FORESIGHT_TRY(std::vector<float> from_first,
                NearestDistances(first, second, context.Part(0.0, 0.5)));
  FORESIGHT_TRY(std::vector<float> from_second,
                NearestDistances(second, first, context.Part(0.5, 1.0)));
  const CloudDistances distances{SummaryOf(from_first), SummaryOf(from_second)};
  comparison.first_cloud = {std::move(first), std::move(from_first)};
  comparison.second_cloud = {std::move(second), std::move(from_second)};
  return distances;
}

/// An empty cloud has no distance: that is an answer. Anything else is a failure.
Status Take(Result<CloudDistances> distances, const char* what,
            std::optional<CloudDistances>& taken, std::vector<std::string>& notes) {
  if (distances) {
    taken = *distances;
    return {};
  }
  if (distances.error().code != ErrorCode::kTooFewPoints) return tl::unexpected(distances.error());
  notes.push_back(fmt::format("{}: {}", what, distances.error().message));
  return {};
}

OrderedJson ToJson(const DepthComparison& depth) {
  return {{"in_both", depth.in_both},
          {"only_in_first", depth.only_in_first},
          {"only_in_second", depth.only_in_second},
          {"in_neither", depth.in_neither},
          {"median_abs_m", FiniteOrNull(depth.median_abs_m)},
          {"p95_abs_m", FiniteOrNull(depth.p95_abs_m)},
          {"max_abs_m", FiniteOrNull(depth.max_abs_m)},
          {"mean_m", FiniteOrNull(depth.mean_m)},
          {"histogram",
           {{"from_m", -DepthComparison::kFullScale_m},
            {"to_m", DepthComparison::kFullScale_m},
            {"below", depth.below_histogram},
            {"above", depth.above_histogram},
            {"pixels", depth.histogram}}}};
}

OrderedJson ToJson(const CloudDistance& distance) {
  return {{"points", distance.points},
          {"median_m", FiniteOrNull(distance.median_m)},
          {"p95_m", FiniteOrNull(distance.p95_m)},
          {"max_m", FiniteOrNull(distance.max_m)}};
}

OrderedJson ToJson(const std::optional<CloudDistances>& distances) {
  if (!distances) return nullptr;
  return {{"from_first", ToJson(distances->from_first)},
          {"from_second", ToJson(distances->from_second)}};
}

OrderedJson ToJson(const std::optional<PlacedObject>& object) {
  if (!object) return nullptr;
  const Eigen::Vector3d& at = object->robot_from_object.translation();
  return {{"detection", object->uuid},
          {"text", object->text},
          {"level", ToString(object->level)},
          {"robot_position_m", {at.x(), at.y(), at.z()}}};
}

OrderedJson ToJson(const ObjectPair& pair) {
  OrderedJson json = {{"kind", pair.first ? pair.first->kind : pair.second->kind},
                      {"first", ToJson(pair.first)},
                      {"second", ToJson(pair.second)},
                      {"difference", nullptr}};
  if (!pair.difference) return json;
  const PoseDifference& d = *pair.difference;
  json["difference"] = {{"distance_m", d.distance_m},
                        {"angle_rad", d.angle_rad},
                        {"shift_m", {d.shift_m.x(), d.shift_m.y(), d.shift_m.z()}},
                        {"turn_rad", {d.turn_rad.x(), d.turn_rad.y(), d.turn_rad.z()}}};
  return json;
}

std::string Words(const CloudDistance& distance) {
  return fmt::format("median {:.1f} mm, 95 % {:.1f} mm, max {:.1f} mm", 1000.0 * distance.median_m,
                     1000.0 * distance.p95_m, 1000.0 * distance.max_m);
}

void AddWords(const char* what, const std::optional<CloudDistances>& distances,
              std::vector<std::string>& lines) {
  if (!distances) return;
  lines.push_back(fmt::format("{}: A to B {}", what, Words(distances->from_first)));
  lines.push_back(fmt::format("{}: B to A {}", what, Words(distances->from_second)));
}

std::string Words(const ObjectPair& pair) {
  const PlacedObject& object = pair.first ? *pair.first : *pair.second;
  if (!pair.difference)
    return fmt::format("{} ({}): only in {}", object.kind, object.text, pair.first ? "A" : "B");
  const PoseDifference& d = *pair.difference;
  return fmt::format(
      "{} ({}): {:.1f} mm (x {:+.1f}, y {:+.1f}, z {:+.1f}), {:.2f} deg (x {:+.2f}, y {:+.2f}, z "
      "{:+.2f})",
      object.kind, object.text, 1000.0 * d.distance_m, 1000.0 * d.shift_m.x(),
      1000.0 * d.shift_m.y(), 1000.0 * d.shift_m.z(), DegreesFromRadians(d.angle_rad),
      DegreesFromRadians(d.turn_rad.x()), DegreesFromRadians(d.turn_rad.y()),
      DegreesFromRadians(d.turn_rad.z()));
}

}  // namespace

Result<ComparedResult> MakeResultAgain(const MissionFile& mission, const MissionFile* review,
                                       std::int64_t scan_id, const std::string& wanted,
                                       std::optional<std::int64_t> image,
                                       const RunContext& context) {
  FORESIGHT_TRY(Scan scan, mission.LoadScan(scan_id));
  ComparedResult result;
  result.name = wanted;
  result.scan_uuid = scan.uuid;
  FORESIGHT_TRY(result.image, ChooseImage(scan, image));
  std::vector<DepthRecord> depths;
  std::vector<DetectionRecord> fits;
  if (wanted == kOriginalResult) {
    FORESIGHT_TRY(result.options, OriginalDepthOptions(mission, scan_id, result.image));
    FORESIGHT_TRY(fits, DetectionsOfScan(mission, review, scan.uuid));
  } else {
    FORESIGHT_TRY(const SideResult side, FindSideResult(mission, review, scan.uuid, wanted));
    result.name = side.name;
    result.options = side.depth;
    if (side.other_rig) {
      FORESIGHT_TRY(scan.rig, RigOf(side, mission, review));
    }
    FORESIGHT_TRY(depths, DepthsOf(mission, review, side.depth_uuids));
    FORESIGHT_TRY(fits, FitsOf(mission, review, side.detection_uuids));
  }
  result.rig = scan.rig;
  FORESIGHT_CHECK(PlaceObjects(fits, result));
  FORESIGHT_TRY(RegisteredScan cloud, RegisterScan(scan, context.Part(0.0, 0.1)));
  result.cloud = std::make_shared<const RegisteredScan>(std::move(cloud));
  if (result.image < 0) return result;
  result.frame = scan.frames[static_cast<std::size_t>(result.image)];
  FORESIGHT_TRY(DepthResult depth, ComputeDepthInFrame(*result.cloud, result.rig, result.frame,
                                                       result.options, context.Part(0.1, 1.0)));
  for (const DepthRecord& record : depths)
    if (record.image_position == result.image && record.digest != DigestOf(depth.dense, depth.mask))
      result.notes.push_back(
          fmt::format("'{}': its depth map is not the one that was kept: this program ({}) makes "
                      "another one",
                      result.name, ProgramVersion()));
  result.depth = std::make_shared<const DepthResult>(std::move(depth));
  return result;
}

std::vector<Eigen::Vector3f> MaskedDepthInRobot(const ComparedResult& result) {
  constexpr int kStride_px = 2;
  std::vector<Eigen::Vector3f> points;
  if (!result.depth) return points;
  const DepthImage& depth_m = result.depth->dense.depth_m;
  const auto robot_from_camera = result.rig.robot_from_base *
                                 result.rig.CameraFromBase(result.frame.motor_angle_rad).Inverse();
  for (int v = 0; v < depth_m.height(); v += kStride_px)
    for (int u = 0; u < depth_m.width(); u += kStride_px) {
      const double depth = depth_m(u, v);
      if (!std::isfinite(depth) || result.depth->mask(u, v) == 0) continue;
      const auto slope = result.rig.camera.UnprojectToPlane({u, v});
      if (!slope) continue;
      const Eigen::Vector3d in_camera(slope->x() * depth, slope->y() * depth, depth);
      points.push_back((robot_from_camera * in_camera).cast<float>());
    }
  return points;
}

Result<ResultComparison> CompareResults(const ComparedResult& first, const ComparedResult& second,
                                        const RunContext& context) {
  ResultComparison comparison;
  comparison.first = first.name;
  comparison.second = second.name;
  comparison.first_scan = first.scan_uuid;
  comparison.second_scan = second.scan_uuid;
  comparison.notes = first.notes;
  comparison.notes.insert(comparison.notes.end(), second.notes.begin(), second.notes.end());
  if (first.scan_uuid != second.scan_uuid)
    comparison.notes.push_back(
        "A and B are two scans: each counts in its own robot's frame, as if the robot had stood at "
        "one place. Make a map of both to bring them together");
  const bool one_image = first.scan_uuid == second.scan_uuid && first.image == second.image &&
                         first.depth && second.depth &&
                         first.depth->mask.SameSize(second.depth->mask);
  if (one_image) {
    comparison.image = first.image;
    comparison.depth = CompareDepth(first.depth->dense.depth_m, first.depth->mask,
                                    second.depth->dense.depth_m, second.depth->mask);
  }
  FORESIGHT_CHECK(
      Take(Distances(ReturnsInRobot(*first.cloud, first.rig),
                     ReturnsInRobot(*second.cloud, second.rig), comparison, context.Part(0.0, 0.5)),
           "lidar returns", comparison.lidar, comparison.notes));
  if (first.depth && second.depth)
    FORESIGHT_CHECK(Take(Distances(MaskedDepthInRobot(first), MaskedDepthInRobot(second),
                                   comparison, context.Part(0.5, 1.0)),
                         "masked depth", comparison.masked, comparison.notes));
  comparison.objects = MatchObjects(first.objects, second.objects);
  return comparison;
}

std::string ComparisonToJson(const ResultComparison& comparison) {
  OrderedJson objects = OrderedJson::array();
  for (const ObjectPair& pair : comparison.objects) objects.push_back(ToJson(pair));
  const OrderedJson json = {
      {"format", 1},
      {"first", comparison.first},
      {"second", comparison.second},
      {"first_scan", comparison.first_scan},
      {"second_scan", comparison.second_scan},
      {"image", comparison.image},
      {"depth", comparison.depth ? ToJson(*comparison.depth) : OrderedJson(nullptr)},
      {"lidar", ToJson(comparison.lidar)},
      {"masked_depth", ToJson(comparison.masked)},
      {"objects", objects},
      {"notes", comparison.notes}};
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::vector<std::string> ComparisonInWords(const ResultComparison& comparison) {
  std::vector<std::string> lines;
  if (comparison.depth) {
    const DepthComparison& d = *comparison.depth;
    lines.push_back(fmt::format("pixels: {} in both, {} only in A, {} only in B", d.in_both,
                                d.only_in_first, d.only_in_second));
    if (d.in_both > 0)
      lines.push_back(
          fmt::format("|B - A|: median {:.1f} mm, 95 % {:.1f} mm, mean B - A {:+.1f} mm",
                      1000.0 * d.median_abs_m, 1000.0 * d.p95_abs_m, 1000.0 * d.mean_m));
  }
  AddWords("lidar returns", comparison.lidar, lines);
  AddWords("masked depth", comparison.masked, lines);
  for (const ObjectPair& pair : comparison.objects) lines.push_back(Words(pair));
  for (const std::string& note : comparison.notes) lines.push_back(note);
  return lines;
}

}  // namespace foresight
