#include "core/calibration/session_file.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/calibration/number_table.h"
#include "core/calibration/view_files.h"
#include "core/geometry/angles.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

constexpr int kFormatVersion = 1;
constexpr std::size_t kMostLines = 100000;  // of one file: 40 minutes of a lidar

const NumberTable kLineTable{{"seq", "time_s", "range_mm"}, true, ""};
const NumberTable kMotorTable{{"time_s", "angle_rad"}, false, ""};

// ---- writing

Status MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  return {};
}

Status WriteText(const fs::path& folder, const std::string& name, const std::string& text) {
  FORESIGHT_CHECK(MakeFolder((folder / name).parent_path()));
  return WriteFileAtomically(folder / name, text);
}

void AppendCorners(char board, const BoardView& view, std::string* text) {
  for (std::size_t i = 0; i < view.corner_ids.size(); ++i)
    fmt::format_to(std::back_inserter(*text), "{},{},{},{}\n", board, view.corner_ids[i],
                   view.pixels[i].x(), view.pixels[i].y());
}

std::string LinesText(const std::vector<LidarLine>& lines) {
  std::string text = "seq,time_s,range_mm\n";
  for (const LidarLine& line : lines) {
    fmt::format_to(std::back_inserter(text), "{},{}", line.seq, line.time_s);
    for (const std::uint16_t range : line.range_mm)
      fmt::format_to(std::back_inserter(text), ",{}", range);
    text += '\n';
  }
  return text;
}

std::string MotorText(const MotorTrack& track) {
  std::string text = "time_s,angle_rad\n";
  for (const MotorSample& sample : track.samples())
    fmt::format_to(std::back_inserter(text), "{},{}\n", sample.time_s, sample.angle_rad);
  return text;
}

std::string BoardFromBoardYaml(const BoardFromBoard& a_from_b) {
  const Eigen::Quaterniond& q = a_from_b.rotation();
  const Eigen::Vector3d& t = a_from_b.translation();
  return fmt::format("{{quaternion_wxyz: [{}, {}, {}, {}], translation_m: [{}, {}, {}]}}", q.w(),
                     q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

/// In double quotes, with what YAML would read as something else escaped.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "\"";
}

class Writer {
 public:
  Writer(const CalibrationSession& session, const fs::path& folder, SessionViews views)
      : session_(session), folder_(folder), views_(views) {}

  Status Write() {
    FORESIGHT_CHECK(session_.Check());
    FORESIGHT_CHECK(WriteText(folder_, "rig.yaml", SensorRigToYaml(session_.prior)));
    yaml_ =
        fmt::format("foresight_calibration_session: {}\nname: {}\nrig: rig.yaml\nmount:\n  a: {}\n",
                    kFormatVersion, Quoted(session_.name), ToText(session_.mount.a));
    if (session_.mount.b)
      yaml_ += fmt::format("  b: {}\n  a_from_b: {}\n", ToText(*session_.mount.b),
                           BoardFromBoardYaml(session_.mount.a_from_b));
    FORESIGHT_CHECK(WriteViews());
    if (!session_.poses.empty()) yaml_ += "poses:\n";
    for (std::size_t pose = 0; pose < session_.poses.size(); ++pose)
      FORESIGHT_CHECK(WritePose(pose, fmt::format("pose_{:02}", pose + 1)));
    // Last: a folder without it is no session.
    return WriteText(folder_, "session.yaml", yaml_);
  }

 private:
  Status WriteViews() {
    if (session_.intrinsic_views.empty()) return {};
    yaml_ +=
        fmt::format("intrinsic_board: {}\nintrinsic_views:\n", ToText(session_.intrinsic_board));
    for (std::size_t i = 0; i < session_.intrinsic_views.size(); ++i) {
      if (views_ == SessionViews::kImages) {
        FORESIGHT_CHECK(MakeFolder(folder_ / "intrinsic"));
        yaml_ += fmt::format("  - {{image: {}}}\n", ImageNameOfView(i));
        continue;
      }
      const std::string name = fmt::format("intrinsic/{:03}.csv", i + 1);
      std::string text = kCornerHeader;
      AppendCorners('a', session_.intrinsic_views[i].view, &text);
      FORESIGHT_CHECK(WriteText(folder_, name, text));
      yaml_ += fmt::format("  - {{corners: {}}}\n", name);
    }
    return {};
  }

  Status WritePose(std::size_t number, const std::string& folder) {
    const PatternPose& pose = session_.poses[number];
    FORESIGHT_CHECK(MakeFolder(folder_ / folder));
    yaml_ += fmt::format("  - name: {}\n    stops:{}\n", Quoted(pose.name),
                         pose.stops.empty() ? " []" : "");
    for (std::size_t i = 0; i < pose.stops.size(); ++i) {
      const MotorStop& stop = pose.stops[i];
      const std::string name = fmt::format("{}/stop_{:02}", folder, i + 1);
      // The shortest decimal number that gives the same angle but for the last digit.
      yaml_ += fmt::format("      - {{motor_deg: {:.12g}", DegreesFromRadians(stop.motor_rad));
      if (!stop.view.empty()) {
        std::string text = kCornerHeader;
        if (stop.view.a) AppendCorners('a', *stop.view.a, &text);
        if (stop.view.b) AppendCorners('b', *stop.view.b, &text);
        FORESIGHT_CHECK(WriteText(folder_, name + "_corners.csv", text));
        yaml_ += fmt::format(", corners: {}_corners.csv", name);
      }
      if (!stop.lines.empty()) {
        FORESIGHT_CHECK(WriteText(folder_, name + "_lines.csv", LinesText(stop.lines)));
        yaml_ += fmt::format(", lines: {}_lines.csv", name);
      }
      yaml_ += "}\n";
    }
    if (pose.sweep.lines.empty()) return {};
    FORESIGHT_CHECK(WriteText(folder_, folder + "/sweep_lines.csv", LinesText(pose.sweep.lines)));
    FORESIGHT_CHECK(WriteText(folder_, folder + "/sweep_motor.csv", MotorText(pose.sweep.track)));
    yaml_ += fmt::format("    sweep: {{lines: {0}/sweep_lines.csv, motor: {0}/sweep_motor.csv}}\n",
                         folder);
    return {};
  }

  const CalibrationSession& session_;
  fs::path folder_;
  SessionViews views_;
  std::string yaml_;
};

// ---- reading

/// What session.yaml says, before the files that it names are read.
struct StopEntry {
  double motor_rad = 0.0;
  ViewEntry view;
  std::string lines;
};
struct PoseEntry {
  std::string name;
  std::vector<StopEntry> stops;
  std::string sweep_lines, sweep_motor;
};
struct SessionEntry {
  std::string rig;
  std::vector<ViewEntry> views;
  std::vector<PoseEntry> poses;
};

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

PoseEntry PoseEntryFromYaml(YamlMap& map, std::size_t number) {
  PoseEntry pose;
  pose.name = map.Text("name", fmt::format("pose {}", number));
  for (YamlMap& entry : map.List("stops")) {
    StopEntry stop;
    stop.motor_rad = RadiansFromDegrees(entry.Number("motor_deg"));
    stop.view = ViewFromYaml(entry);
    stop.lines = OptionalFileNameFromYaml(entry, "lines");
    entry.Finish();
    pose.stops.push_back(std::move(stop));
  }
  if (map.Has("sweep")) {
    YamlMap sweep = map.Map("sweep");
    pose.sweep_lines = FileNameFromYaml(sweep, "lines");
    pose.sweep_motor = FileNameFromYaml(sweep, "motor");
    sweep.Finish();
  }
  map.Finish();
  return pose;
}

SessionEntry SessionFromYaml(YamlMap& map, CalibrationSession* session) {
  const int version = map.Integer("foresight_calibration_session");
  if (version != kFormatVersion)
    map.Fault(fmt::format("version {} of the format is not known, this program reads {}", version,
                          kFormatVersion));
  SessionEntry entry;
  session->name = map.Text("name", "unnamed");
  entry.rig = FileNameFromYaml(map, "rig");
  session->mount = MountFromYaml(map.Map("mount"));
  if (map.Has("intrinsic_views")) session->intrinsic_board = BoardFromYaml(map, "intrinsic_board");
  for (YamlMap& view : map.List("intrinsic_views")) {
    entry.views.push_back(ViewFromYaml(view));
    view.Finish();
    if (entry.views.back().empty()) view.Fault("a view needs an image or corners");
  }
  for (YamlMap& pose : map.List("poses"))
    entry.poses.push_back(PoseEntryFromYaml(pose, entry.poses.size() + 1));
  map.Finish();
  return entry;
}

Result<std::vector<LidarLine>> ReadLines(const fs::path& path, const LidarModel& lidar) {
  std::vector<LidarLine> lines;
  const auto on_row = [&](int number, std::span<const double> row) -> Status {
    if (row.size() - 2 != static_cast<std::size_t>(lidar.beams))
      return Fail(ErrorCode::kBadData, "{}:{}: {} ranges, the rig's lidar has {} beams",
                  path.string(), number, row.size() - 2, lidar.beams);
    if (lines.size() == kMostLines)
      return Fail(ErrorCode::kBadData, "{}:{}: more than {} lines", path.string(), number,
                  kMostLines);
    LidarLine line;
    if (std::abs(row[0]) > 1e15)
      return Fail(ErrorCode::kBadData, "{}:{}: {} is no number of a line", path.string(), number,
                  row[0]);
    line.seq = static_cast<std::int64_t>(row[0]);
    line.time_s = row[1];
    for (const double range : row.subspan(2)) {
      if (range < 0.0 || range > 65535.0 || range != std::floor(range))
        return Fail(ErrorCode::kBadData, "{}:{}: {} is no range in millimetres", path.string(),
                    number, range);
      line.range_mm.push_back(static_cast<std::uint16_t>(range));
    }
    lines.push_back(std::move(line));
    return {};
  };
  FORESIGHT_CHECK(ReadNumberTable(path, kLineTable, on_row));
  return lines;
}

Result<MotorTrack> ReadTrack(const fs::path& path) {
  std::vector<MotorSample> samples;
  FORESIGHT_CHECK(
      ReadNumberTable(path, kMotorTable, [&](int, std::span<const double> row) -> Status {
        samples.push_back({row[0], row[1]});
        return {};
      }));
  auto track = MotorTrack::FromSamples(std::move(samples));
  if (!track) return Fail(ErrorCode::kBadData, "{}: {}", path.string(), track.error().message);
  return track;
}

/// One image, or file of corners, and what is in it.
struct ViewJob {
  ViewEntry entry;
  const CalibrationBoard* a = nullptr;
  const CalibrationBoard* b = nullptr;
  SearchEffort effort = SearchEffort::kThorough;
  MountView view;
  Status status;
};

class Loader {
 public:
  Loader(const fs::path& folder, const RunContext& context) : folder_(folder), context_(context) {}

  Result<CalibrationSession> Load() {
    const fs::path file = folder_ / "session.yaml";
    FORESIGHT_TRY(const std::string text, ReadFile(file));
    FORESIGHT_CHECK(ParseYaml(text, file.string(),
                              [&](YamlMap& map) { entry_ = SessionFromYaml(map, &session_); }));
    FORESIGHT_TRY(session_.prior, LoadSensorRig(folder_ / entry_.rig));
    FORESIGHT_CHECK(LoadViews());
    for (std::size_t pose = 0; pose < entry_.poses.size(); ++pose)
      FORESIGHT_CHECK(LoadPose(entry_.poses[pose], &session_.poses[pose]));
    if (const Status status = session_.Check(); !status)
      return Fail(ErrorCode::kBadData, "{}: {}", file.string(), status.error().message);
    return std::move(session_);
  }

 private:
  /// Images are looked at on all threads.
  Status LoadViews() {
    std::vector<ViewJob> jobs;
    for (const ViewEntry& entry : entry_.views)
      jobs.push_back({entry, &session_.intrinsic_board, nullptr, SearchEffort::kThorough, {}, {}});
    const CalibrationBoard* b = session_.mount.b ? &*session_.mount.b : nullptr;
    for (const PoseEntry& pose : entry_.poses)
      for (const StopEntry& stop : pose.stops)
        if (!stop.view.empty())
          // At many stops no board is in sight, and nobody wants to know what is there instead.
          jobs.push_back({stop.view, &session_.mount.a, b, SearchEffort::kQuick, {}, {}});
    std::atomic<int> done = 0;
    const int count = static_cast<int>(jobs.size());
    const bool finished = ParallelFor(count, context_, [&](int i) {
      ViewJob& job = jobs[static_cast<std::size_t>(i)];
      auto view = ReadView(folder_, job.entry, session_.prior.camera, job.a, job.b, job.effort);
      if (view)
        job.view = std::move(*view);
      else
        job.status = tl::unexpected(view.error());
      context_.Report(static_cast<double>(++done) / count, "looking for boards");
    });
    if (!finished) return Fail(ErrorCode::kCancelled, "reading the session: cancelled");
    for (const ViewJob& job : jobs) FORESIGHT_CHECK(job.status);
    std::size_t next = 0;
    for (std::size_t i = 0; i < entry_.views.size(); ++i, ++next)
      if (jobs[next].view.a)
        session_.intrinsic_views.push_back({jobs[next].view.source, *jobs[next].view.a});
    for (const PoseEntry& entry : entry_.poses) {
      PatternPose pose;
      pose.name = entry.name;
      for (const StopEntry& stop : entry.stops) {
        pose.stops.push_back({stop.motor_rad, {}, {}});
        if (!stop.view.empty()) pose.stops.back().view = std::move(jobs[next++].view);
      }
      session_.poses.push_back(std::move(pose));
    }
    return {};
  }

  Status LoadPose(const PoseEntry& entry, PatternPose* pose) {
    if (context_.Cancelled()) return Fail(ErrorCode::kCancelled, "reading the session: cancelled");
    for (std::size_t i = 0; i < entry.stops.size(); ++i) {
      if (entry.stops[i].lines.empty()) continue;
      FORESIGHT_TRY(pose->stops[i].lines,
                    ReadLines(folder_ / entry.stops[i].lines, session_.prior.lidar));
    }
    if (!entry.sweep_lines.empty()) {
      FORESIGHT_TRY(pose->sweep.lines,
                    ReadLines(folder_ / entry.sweep_lines, session_.prior.lidar));
      FORESIGHT_TRY(pose->sweep.track, ReadTrack(folder_ / entry.sweep_motor));
    }
    return {};
  }

  fs::path folder_;
  const RunContext& context_;
  SessionEntry entry_;
  CalibrationSession session_;
};

}  // namespace

Result<CalibrationSession> ReadCalibrationSession(const fs::path& folder,
                                                  const RunContext& context) {
  return Loader(folder, context).Load();
}

Status WriteCalibrationSession(const CalibrationSession& session, const fs::path& folder,
                               SessionViews views) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Fail(ErrorCode::kIo, "{}: {}", folder.string(), error.message());
  if (!fs::is_empty(folder, error) || error)
    return Fail(ErrorCode::kIo, "{}: the folder is not empty; name a new one", folder.string());
  return Writer(session, folder, views).Write();
}

std::string SessionHash(const CalibrationSession& session) {
  Sha256 hash;
  const auto add_view = [&hash](const MountView& view) {
    std::string text = kCornerHeader;
    if (view.a) AppendCorners('a', *view.a, &text);
    if (view.b) AppendCorners('b', *view.b, &text);
    hash.Add(text);
  };
  hash.Add(RigId(session.prior) + "\nboards\n" + ToText(session.mount.a) + "\n");
  if (session.mount.b)
    hash.Add(ToText(*session.mount.b) + "\n" + BoardFromBoardYaml(session.mount.a_from_b) + "\n");
  if (!session.intrinsic_views.empty()) hash.Add(ToText(session.intrinsic_board) + "\n");
  for (const IntrinsicView& view : session.intrinsic_views) add_view({"", view.view, {}});
  for (const PatternPose& pose : session.poses) {
    hash.Add("pose\n");
    for (const MotorStop& stop : pose.stops) {
      hash.Add(fmt::format("stop {:.9f}\n", DegreesFromRadians(stop.motor_rad)));
      add_view(stop.view);
      hash.Add(LinesText(stop.lines));
    }
    hash.Add("sweep\n").Add(LinesText(pose.sweep.lines)).Add(MotorText(pose.sweep.track));
  }
  return hash.Hex();
}

std::string ImageNameOfView(std::size_t view) {
  return fmt::format("intrinsic/{:03}.png", view + 1);
}

}  // namespace foresight
