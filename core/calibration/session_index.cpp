#include "core/calibration/session_index.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/printable.h"
#include "core/calibration/view_files.h"
#include "core/geometry/angles.h"
#include "core/io/yaml_reader.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr int kIndexFormatVersion = 1;
constexpr const char* kFile = "session.yaml";

// ---- writing

/// In double quotes, with what YAML would read as something else escaped.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : Printable(text)) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

/// Names that this program gives stand as they are.
std::string FileYaml(const std::string& name) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '/';
  };
  return std::all_of(name.begin(), name.end(), plain) ? name : Quoted(name);
}

std::string MountYaml(const BoardMount& mount) {
  std::string yaml = fmt::format("mount:\n  a: {}\n", ToText(mount.a));
  if (!mount.b) return yaml;
  const Eigen::Quaterniond& q = mount.a_from_b.rotation();
  const Eigen::Vector3d& t = mount.a_from_b.translation();
  yaml += fmt::format("  b: {}\n", ToText(*mount.b));
  yaml += fmt::format(
      "  a_from_b: {{quaternion_wxyz: [{}, {}, {}, {}], translation_m: [{}, {}, {}]}}\n", q.w(),
      q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
  return yaml;
}

std::string ViewYaml(const SessionViewFiles& view) {
  std::string yaml =
      fmt::format("{}: {}", view.image.empty() ? "corners" : "image", FileYaml(view.File()));
  if (!view.origin.empty()) yaml += ", origin: " + Quoted(view.origin);
  return yaml;
}

std::string StopYaml(const SessionStopFiles& stop) {
  // The shortest decimal number that gives the same angle but for the last digit.
  std::string yaml = fmt::format("motor_deg: {:.12g}", DegreesFromRadians(stop.motor_rad));
  if (stop.measured_rad)
    yaml += fmt::format(", measured_deg: {:.12g}", DegreesFromRadians(*stop.measured_rad));
  if (!stop.view.empty()) yaml += ", " + ViewYaml(stop.view);
  if (stop.view.excluded) yaml += ", view_excluded: true";
  if (!stop.lines.empty()) yaml += ", lines: " + FileYaml(stop.lines);
  if (stop.lines_excluded) yaml += ", lines_excluded: true";
  if (stop.excluded) yaml += ", excluded: true";
  return yaml;
}

std::string SweepYaml(const SessionSweepFiles& sweep) {
  return fmt::format("{{lines: {}, motor: {}{}}}", FileYaml(sweep.lines), FileYaml(sweep.motor),
                     sweep.excluded ? ", excluded: true" : "");
}

std::string PoseYaml(const SessionPoseFiles& pose) {
  std::string yaml = fmt::format("  - name: {}\n", Quoted(pose.name));
  if (pose.excluded) yaml += "    excluded: true\n";
  yaml += pose.stops.empty() ? "    stops: []\n" : "    stops:\n";
  for (const SessionStopFiles& stop : pose.stops)
    yaml += fmt::format("      - {{{}}}\n", StopYaml(stop));
  if (pose.sweeps.size() == 1)
    return yaml + fmt::format("    sweep: {}\n", SweepYaml(pose.sweeps.front()));
  if (!pose.sweeps.empty()) yaml += "    sweeps:\n";
  for (const SessionSweepFiles& sweep : pose.sweeps)
    yaml += fmt::format("      - {}\n", SweepYaml(sweep));
  return yaml;
}

std::string IndexYaml(const SessionIndex& index) {
  std::string yaml =
      fmt::format("foresight_calibration_session: {}\nname: {}\nrig: {}\n{}", kIndexFormatVersion,
                  Quoted(index.name), FileYaml(index.rig), MountYaml(index.mount));
  if (index.intrinsic_board)
    yaml += fmt::format("intrinsic_board: {}\n", ToText(*index.intrinsic_board));
  if (!index.intrinsic_views.empty()) yaml += "intrinsic_views:\n";
  for (const SessionViewFiles& view : index.intrinsic_views)
    yaml += fmt::format("  - {{{}{}}}\n", ViewYaml(view), view.excluded ? ", excluded: true" : "");
  if (!index.poses.empty()) yaml += "poses:\n";
  for (const SessionPoseFiles& pose : index.poses) yaml += PoseYaml(pose);
  return yaml;
}

// ---- reading

SessionViewFiles ViewFromYaml(YamlMap& map, const char* excluded) {
  SessionViewFiles view = ViewFromYaml(map);
  view.excluded = map.Flag(excluded, false);
  return view;
}

BoardMount MountFromYaml(YamlMap map) {
  BoardMount mount;
  mount.a = BoardFromYaml(map, "a");
  if (map.Has("b")) {
    mount.b = BoardFromYaml(map, "b");
    mount.a_from_b = PoseFromYaml<frame::Pattern, frame::Pattern>(map.Map("a_from_b"));
    if (mount.a_from_b.translation().norm() > 10.0)
      map.Fault(map.Node("a_from_b"), "the boards are over 10 m apart");
  }
  map.Finish();
  return mount;
}

SessionStopFiles StopFromYaml(YamlMap& map) {
  SessionStopFiles stop;
  stop.motor_rad = RadiansFromDegrees(map.Number("motor_deg"));
  if (map.Has("measured_deg")) stop.measured_rad = RadiansFromDegrees(map.Number("measured_deg"));
  stop.view = ViewFromYaml(map, "view_excluded");
  stop.lines = OptionalFileNameFromYaml(map, "lines");
  stop.lines_excluded = map.Flag("lines_excluded", false);
  stop.excluded = map.Flag("excluded", false);
  map.Finish();
  return stop;
}

SessionSweepFiles SweepFromYaml(YamlMap& map) {
  SessionSweepFiles sweep{.lines = FileNameFromYaml(map, "lines"),
                          .motor = FileNameFromYaml(map, "motor"),
                          .excluded = map.Flag("excluded", false)};
  map.Finish();
  return sweep;
}

SessionPoseFiles PoseFromYaml(YamlMap& map, std::size_t number) {
  SessionPoseFiles pose;
  pose.name = map.Text("name", fmt::format("pose {}", number));
  pose.excluded = map.Flag("excluded", false);
  for (YamlMap& stop : map.List("stops")) pose.stops.push_back(StopFromYaml(stop));
  if (map.Has("sweep")) {
    YamlMap sweep = map.Map("sweep");
    pose.sweeps.push_back(SweepFromYaml(sweep));
  }
  for (YamlMap& sweep : map.List("sweeps")) pose.sweeps.push_back(SweepFromYaml(sweep));
  map.Finish();
  return pose;
}

SessionIndex IndexFromYaml(YamlMap& map) {
  const int version = map.Integer("foresight_calibration_session");
  if (version != kIndexFormatVersion)
    map.Fault(fmt::format("version {} of the format is not known, this program reads {}", version,
                          kIndexFormatVersion));
  SessionIndex index;
  index.name = map.Text("name", "unnamed");
  index.rig = FileNameFromYaml(map, "rig");
  index.mount = MountFromYaml(map.Map("mount"));
  if (map.Has("intrinsic_board") || map.Has("intrinsic_views"))
    index.intrinsic_board = BoardFromYaml(map, "intrinsic_board");
  for (YamlMap& view : map.List("intrinsic_views")) {
    index.intrinsic_views.push_back(ViewFromYaml(view, "excluded"));
    view.Finish();
    if (index.intrinsic_views.back().empty()) view.Fault("a view needs an image or corners");
  }
  for (YamlMap& pose : map.List("poses"))
    index.poses.push_back(PoseFromYaml(pose, index.poses.size() + 1));
  map.Finish();
  return index;
}

// ---- checking

Status CheckStops(const SessionPoseFiles& pose) {
  for (std::size_t i = 0; i < pose.stops.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const SessionStopFiles &a = pose.stops[i], &b = pose.stops[j];
      if (!a.excluded && !b.excluded && std::abs(a.motor_rad - b.motor_rad) < kSameStop_rad)
        return Fail(ErrorCode::kInvalidInput, "{}: the stop {:.2f} deg is there twice", pose.name,
                    DegreesFromRadians(a.motor_rad));
    }
  return {};
}

}  // namespace

Status SessionIndex::Check() const {
  FORESIGHT_CHECK(mount.Check());
  if (!intrinsic_views.empty() && !intrinsic_board)
    return Fail(ErrorCode::kInvalidInput, "there are intrinsic views, but no board is named");
  if (intrinsic_board) FORESIGHT_CHECK(intrinsic_board->Check());
  for (const SessionPoseFiles& pose : poses) {
    FORESIGHT_CHECK(CheckStops(pose));
    const auto used = [](const SessionSweepFiles& sweep) { return !sweep.excluded; };
    if (std::count_if(pose.sweeps.begin(), pose.sweeps.end(), used) > 1)
      return Fail(ErrorCode::kInvalidInput, "{}: there are two sweeps; exclude one", pose.name);
  }
  return {};
}

Result<SessionIndex> ReadSessionIndex(const fs::path& folder) {
  const fs::path file = folder / kFile;
  SessionIndex index;
  FORESIGHT_TRY(const std::string text, ReadFile(file));
  FORESIGHT_CHECK(
      ParseYaml(text, file.string(), [&index](YamlMap& map) { index = IndexFromYaml(map); }));
  if (const Status status = index.Check(); !status)
    return Fail(ErrorCode::kBadData, "{}: {}", file.string(), status.error().message);
  return index;
}

Status WriteSessionIndex(const SessionIndex& index, const fs::path& folder) {
  FORESIGHT_CHECK(index.Check());
  return WriteFileAtomically(folder / kFile, IndexYaml(index));
}

bool IsCalibrationSession(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kFile, error);
}

}  // namespace foresight
