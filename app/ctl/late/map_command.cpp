#include <algorithm>
#include <memory>
#include <optional>

#include "app/ctl/command.h"
#include "app/ctl/late/late_command.h"
#include "core/geometry/angles.h"
#include "core/io/point_cloud_file.h"
#include "core/mapping/mission_map.h"
#include "core/registration/export_cloud.h"

namespace foresight {
namespace {

struct MapArguments {
  std::string mission;
  std::vector<std::int64_t> scans;
  std::string odometry;
  std::string out;
  std::vector<std::int64_t> changes;
  bool json = false;
};

Status WriteMap(const MapArguments& arguments, const MissionFile& mission, const MissionMap& map,
                std::size_t& count) {
  std::vector<CloudPoint> points;
  for (const MappedScan& entry : map.scans) {
    if (!entry.place.InMap()) continue;
    FORESIGHT_TRY(const Scan scan, mission.LoadScan(entry.id));
    for (CloudPoint point : PointsInRobot(entry.cloud, scan)) {
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

Result<ExitCode> Map(const MapArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.mission));
  MapOdometry odometry;
  if (!arguments.odometry.empty()) {
    FORESIGHT_TRY(odometry, LoadMapOdometry(arguments.odometry));
  }
  FORESIGHT_TRY(const MissionMap map,
                MapMission(*mission, arguments.scans, odometry, context.Part(0.0, 0.8)));
  for (const std::string& sentence : map.left_out) PrintNote("{}", sentence);
  const std::vector<MappedScan>& scans = map.scans;
  std::size_t points = 0;
  if (!arguments.out.empty()) FORESIGHT_CHECK(WriteMap(arguments, *mission, map, points));
  std::optional<ScanChanges> changes;
  if (arguments.changes.size() == 2) {
    FORESIGHT_TRY(changes, FindChangesInMap(map, arguments.changes[0], arguments.changes[1], {},
                                            context.Part(0.8, 1.0)));
  }
  const bool all = std::all_of(scans.begin(), scans.end(),
                               [](const MappedScan& entry) { return entry.place.InMap(); });
  auto json = nlohmann::ordered_json::object();
  std::string text;
  json["mission"] = arguments.mission;
  json["scans"] = nlohmann::ordered_json::array();
  for (const MappedScan& entry : scans) {
    json["scans"].push_back(ToJson(entry));
    text += PlaceText(entry) + "\n";
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
      text += ChangeText(change) + "\n";
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

extern "C" void AddMapOptions(CLI::App* command, Invocation* invocation) {
  const auto arguments = std::make_shared<MapArguments>();
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
  command->callback([invocation, arguments] {
    *invocation = [arguments](const RunContext& context) { return Map(*arguments, context); };
  });
}

}  // namespace foresight
