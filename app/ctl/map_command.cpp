#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "app/ctl/command.h"
#include "core/calibration/number_table.h"
#include "core/geometry/angles.h"
#include "core/io/point_cloud_file.h"
#include "core/mapping/scan_changes.h"
#include "core/mapping/scan_map.h"
#include "core/mission/mission_file.h"
#include "core/registration/export_cloud.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Map, frame::Robot>;

struct MapArguments {
  std::string mission;
  std::vector<std::int64_t> scans;
  std::string odometry;
  std::string out;
  std::vector<std::int64_t> changes;
  bool json = false;
};

/// A scan of the mission with its place.
struct MappedScan {
  std::int64_t id = 0;
  Scan scan;
  RegisteredScan cloud;
  MapPlace place;
};

Result<std::map<std::int64_t, Pose>> ReadOdometry(const std::string& file) {
  std::map<std::int64_t, Pose> poses;
  if (file.empty()) return poses;
  const NumberTable table{{"scan", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}, false, ""};
  const auto add = [&](int line, std::span<const double> row) -> Status {
    const Eigen::Quaterniond rotation(row[4], row[5], row[6], row[7]);
    if (std::abs(rotation.norm() - 1.0) > 1e-3)
      return Fail(ErrorCode::kBadData, "{}:{}: the quaternion has the length {}, not 1", file, line,
                  rotation.norm());
    const auto id = static_cast<std::int64_t>(row[0]);
    if (!poses.try_emplace(id, rotation.normalized(), Eigen::Vector3d(row[1], row[2], row[3]))
             .second)
      return Fail(ErrorCode::kBadData, "{}:{}: scan {} stands there twice", file, line, id);
    return {};
  };
  FORESIGHT_CHECK(ReadNumberTable(file, table, add));
  return poses;
}

Result<std::vector<MappedScan>> LoadScans(const MapArguments& arguments) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.mission));
  FORESIGHT_TRY(const std::vector<ScanSummary> list, mission->ListScans());
  std::vector<std::int64_t> ids = arguments.scans;
  if (ids.empty())
    for (const ScanSummary& scan : list) ids.push_back(scan.id);
  std::vector<MappedScan> scans;
  for (const std::int64_t id : ids) {
    MappedScan entry;
    entry.id = id;
    FORESIGHT_TRY(entry.scan, mission->LoadScan(id));
    const auto cloud = RegisterScan(entry.scan, {});
    if (!cloud) {
      PrintNote("scan {} is left out: {}", id, cloud.error().message);
      continue;
    }
    entry.cloud = *cloud;
    scans.push_back(std::move(entry));
  }
  if (scans.empty())
    return Fail(ErrorCode::kInvalidInput, "{}: holds no scan with a return", arguments.mission);
  return scans;
}

Status PlaceAll(const MapArguments& arguments, std::vector<MappedScan>& scans,
                const RunContext& context) {
  FORESIGHT_TRY(const auto odometry, ReadOdometry(arguments.odometry));
  std::vector<ScanForMap> inputs;
  for (const MappedScan& entry : scans) {
    const auto pose = odometry.find(entry.id);
    inputs.push_back({entry.cloud, entry.scan.rig,
                      pose == odometry.end() ? std::nullopt : std::optional(pose->second)});
  }
  FORESIGHT_TRY(const std::vector<MapPlace> places, PlaceScans(inputs, {}, context));
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i].place = places[i];
  return {};
}

Status WriteMap(const MapArguments& arguments, const std::vector<MappedScan>& scans,
                std::size_t& count) {
  std::vector<CloudPoint> points;
  for (const MappedScan& entry : scans) {
    if (!entry.place.InMap()) continue;
    for (CloudPoint point : PointsInRobot(entry.cloud, entry.scan)) {
      const Eigen::Vector3d place =
          entry.place.map_from_robot * Eigen::Vector3d(point.x, point.y, point.z);
      point.x = static_cast<float>(place.x());
      point.y = static_cast<float>(place.y());
      point.z = static_cast<float>(place.z());
      points.push_back(point);
    }
  }
  count = points.size();
  const std::filesystem::path path = arguments.out;
  const auto write = path.extension() == ".pcd" ? WritePcd : WritePly;
  return write(path, points, CloudFields::kMeasured, {frame::Map::kName, "", 0});
}

Result<PlacedScan> Placed(const std::vector<MappedScan>& scans, std::int64_t id) {
  for (const MappedScan& entry : scans) {
    if (entry.id != id) continue;
    if (!entry.place.InMap())
      return Fail(ErrorCode::kInvalidInput, "scan {} is not in the map: {}", id,
                  entry.place.failure);
    return PlacedScan{entry.cloud, entry.place.map_from_robot * entry.scan.rig.robot_from_base};
  }
  return Fail(ErrorCode::kInvalidInput, "scan {} is not among those of the map", id);
}

nlohmann::ordered_json Vector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

nlohmann::ordered_json ToJson(const MappedScan& entry) {
  nlohmann::ordered_json json = {{"scan", entry.id}, {"in_map", entry.place.InMap()}};
  if (!entry.place.InMap()) {
    json["reason"] = entry.place.failure;
    return json;
  }
  json["map_from_robot"] = ToJson(entry.place.map_from_robot);
  if (!entry.place.alignment) return json;
  const CloudAlignment& a = *entry.place.alignment;
  json["rms_mm"] = 1e3 * a.rms_m;
  json["overlap_ratio"] = a.overlap_ratio;
  json["largest_sigma_mm"] = 1e3 * a.largest_sigma_m;
  json["largest_sigma_deg"] = DegreesFromRadians(a.largest_sigma_rad);
  json["undetermined"] = a.undetermined;
  return json;
}

std::string Line(const MappedScan& entry) {
  if (!entry.place.InMap())
    return fmt::format("scan {}: not in the map: {}", entry.id, entry.place.failure);
  const Eigen::Vector3d& t = entry.place.map_from_robot.translation();
  std::string text =
      fmt::format("scan {}: robot at ({:.3f}, {:.3f}, {:.3f}) m", entry.id, t.x(), t.y(), t.z());
  if (!entry.place.alignment) return text + ", the map's frame";
  const CloudAlignment& a = *entry.place.alignment;
  text += fmt::format(", {:.1f} mm rms over {:.0f} % of its points", 1e3 * a.rms_m,
                      100.0 * a.overlap_ratio);
  for (const std::string& sentence : a.undetermined) text += "; " + sentence;
  return text;
}

Result<ExitCode> Map(const MapArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(std::vector<MappedScan> scans, LoadScans(arguments));
  FORESIGHT_CHECK(PlaceAll(arguments, scans, context.Part(0.1, 0.8)));
  std::size_t points = 0;
  if (!arguments.out.empty()) FORESIGHT_CHECK(WriteMap(arguments, scans, points));
  std::optional<ScanChanges> changes;
  if (arguments.changes.size() == 2) {
    FORESIGHT_TRY(const PlacedScan before, Placed(scans, arguments.changes[0]));
    FORESIGHT_TRY(const PlacedScan after, Placed(scans, arguments.changes[1]));
    FORESIGHT_TRY(changes, FindChanges(before, after, {}, context.Part(0.8, 1.0)));
  }
  const bool all = std::all_of(scans.begin(), scans.end(),
                               [](const MappedScan& entry) { return entry.place.InMap(); });
  auto json = nlohmann::ordered_json::object();
  std::string text;
  json["mission"] = arguments.mission;
  json["scans"] = nlohmann::ordered_json::array();
  for (const MappedScan& entry : scans) {
    json["scans"].push_back(ToJson(entry));
    text += Line(entry) + "\n";
  }
  if (!arguments.out.empty()) {
    json["out"] = arguments.out;
    json["points"] = points;
    text += fmt::format("{}: {} points in the map's frame\n", arguments.out, points);
  }
  if (changes) {
    json["changes"] = nlohmann::ordered_json::array();
    for (const ScanChange& change : changes->changes) {
      json["changes"].push_back({{"kind", ToString(change.kind)},
                                 {"points", change.points.size()},
                                 {"centre_m", Vector(change.centre)},
                                 {"size_m", Vector(change.size_m)}});
      text += fmt::format(
          "{}: {} points round ({:.2f}, {:.2f}, {:.2f}) m, {:.2f} x {:.2f} x {:.2f} m\n",
          ToString(change.kind), change.points.size(), change.centre.x(), change.centre.y(),
          change.centre.z(), change.size_m.x(), change.size_m.y(), change.size_m.z());
    }
    json["not_seen_before"] = changes->not_seen_before;
    if (changes->changes.empty()) text += "nothing has changed\n";
  }
  text.pop_back();
  if (arguments.json)
    PrintJson(json);
  else
    PrintLine(text);
  return all ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddMapCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<MapArguments>();
  CLI::App* command = app.add_subcommand(
      "map", "Bring the scans of a mission together, and find what changed between two");
  command->add_option("mission", arguments->mission, "Mission file")->required();
  command
      ->add_option("--scan", arguments->scans,
                   "Only these scans, in this order; the first is the map's frame")
      ->delimiter(',');
  command->add_option(
      "--odometry", arguments->odometry,
      "CSV scan,x_m,y_m,z_m,qw,qx,qy,qz: where the robot believes it stood; without "
      "it each scan is looked for where the last one was");
  command->add_option("-o,--out", arguments->out,
                      "File for all points: PCD where its name ends in .pcd, else PLY");
  command->add_option("--changes", arguments->changes, "The earlier and the later of two scans")
      ->delimiter(',')
      ->expected(2);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Map(*arguments, context); };
  });
}

}  // namespace foresight
