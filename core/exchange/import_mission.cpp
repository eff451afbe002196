#include "core/exchange/import_mission.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/printable.h"
#include "core/base/publish_file.h"
#include "core/base/utc_text.h"
#include "core/calibration/kitti_calibration.h"
#include "core/exchange/import_bag.h"
#include "core/io/cloud_columns.h"
#include "core/io/jpeg.h"
#include "core/io/png.h"
#include "core/mission/mission_file.h"

namespace foresight {
namespace {

using Path = std::filesystem::path;

/// Files that make one scan, or the scans of one bag.
struct Group {
  std::string name;
  Path cloud;
  std::vector<Path> images;
  Path record;  ///< scan.json; empty = none
};

struct Sources {
  std::vector<Group> groups;
  std::vector<Path> images;  ///< that still belong to a cloud
  std::optional<SensorRig> rig;
  std::string kitti;  ///< the calibration's text; empty = none
  std::string kitti_source;
};

bool IsThere(const Path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

bool IsFolder(const Path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

bool HasExtension(const Path& path, std::initializer_list<const char*> extensions) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* known) { return extension == known; });
}

/// "image-10.png" comes behind "image-9.png".
bool InOrder(const Path& a, const Path& b) {
  const std::string x = a.filename().string(), y = b.filename().string();
  return x.size() != y.size() ? x.size() < y.size() : x < y;
}

Result<Group> GroupOfFolder(const Path& folder) {
  Group group;
  group.name = folder.filename().empty() ? folder.parent_path().filename().string()
                                         : folder.filename().string();
  for (const char* name : {"cloud.pcd", "cloud.ply"})
    if (IsThere(folder / name)) group.cloud = folder / name;
  if (IsThere(folder / "scan.json")) group.record = folder / "scan.json";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("image-") && HasExtension(entry.path(), {".png"}))
      group.images.push_back(entry.path());
  }
  std::sort(group.images.begin(), group.images.end(), InOrder);
  if (group.record.empty())
    return Fail(ErrorCode::kBadData,
                "{}: is no exported scan: scan.json is missing. Name its files one by one",
                folder.string());
  return group;
}

/// A scan's folder of an export, or the folder that holds them.
Status AddFolder(const Path& folder, Sources& sources) {
  if (IsThere(folder / "cloud.ply") || IsThere(folder / "cloud.pcd")) {
    FORESIGHT_TRY(Group group, GroupOfFolder(folder));
    sources.groups.push_back(std::move(group));
    return {};
  }
  std::vector<Path> scans;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().filename().string().starts_with("scan-") && IsFolder(entry.path()))
      scans.push_back(entry.path());
  std::sort(scans.begin(), scans.end(), InOrder);
  if (scans.empty())
    return Fail(ErrorCode::kInvalidInput,
                "{}: holds no cloud.ply or cloud.pcd, and no folder scan-... of an export",
                folder.string());
  for (const Path& scan : scans) {
    if (!IsThere(scan / "cloud.ply") && !IsThere(scan / "cloud.pcd"))
      return Fail(ErrorCode::kInvalidInput, "{}: holds no cloud.ply or cloud.pcd", scan.string());
    FORESIGHT_CHECK(AddFolder(scan, sources));
  }
  return {};
}

/// "Tr: 1 0 0 ...": a calibration's row, and never a point.
bool HasNamedRow(std::string_view text) {
  constexpr int kMostLines = 64;  // a calibration has about eight
  for (int i = 0; i < kMostLines; ++i) {
    const auto line = TakeLine(text);
    if (!line) break;
    const std::vector<std::string_view> words = Words(*line);
    if (words.size() > 1 && words[0].size() > 1 && words[0].ends_with(':')) return true;
  }
  return false;
}

Status AddSource(const Path& path, Sources& sources) {
  if (IsFolder(path)) return AddFolder(path, sources);
  if (HasExtension(path, {".png", ".jpg", ".jpeg"})) {
    sources.images.push_back(path);
    return {};
  }
  if (HasExtension(path, {".yaml", ".yml"})) {
    if (sources.rig)
      return Fail(ErrorCode::kInvalidInput, "{}: there is a rig already", path.string());
    FORESIGHT_TRY(sources.rig, LoadSensorRig(path));
    return {};
  }
  if (HasExtension(path, {".txt"})) {
    FORESIGHT_TRY(std::string text, ReadFile(path));
    if (LooksLikeKittiCalibration(text)) {
      if (!sources.kitti.empty())
        return Fail(ErrorCode::kInvalidInput, "{}: there is a calibration already", path.string());
      sources.kitti = std::move(text);
      sources.kitti_source = path.string();
      return {};
    }
    if (HasNamedRow(text))
      return Fail(ErrorCode::kBadData,
                  "{}: is neither points nor a calibration of KITTI: it has no row P2",
                  path.string());
  }
  sources.groups.push_back({path.filename().string(), path, {}, {}});
  return {};
}

/// "a.bin and b.bin", "a.bin, b.bin and 3 more".
std::string NamesOf(const std::vector<Group>& groups) {
  constexpr std::size_t kMostNames = 3;
  std::string names;
  const std::size_t named = groups.size() > kMostNames ? kMostNames - 1 : groups.size();
  for (std::size_t i = 0; i < named; ++i) {
    const bool last = i + 1 == groups.size();
    names += (i == 0 ? "" : last ? " and " : ", ") + Printable(groups[i].cloud.string());
  }
  if (named < groups.size()) names += fmt::format(" and {} more", groups.size() - named);
  return names;
}

/// Each image to the cloud that it belongs to.
Status ShareImages(Sources& sources) {
  for (const Path& image : sources.images) {
    Group* owner = sources.groups.size() == 1 ? &sources.groups.front() : nullptr;
    for (Group& group : sources.groups)
      if (sources.groups.size() > 1 &&
          image.stem().string().starts_with(group.cloud.stem().string()))
        owner = &group;
    if (owner == nullptr)
      return Fail(ErrorCode::kInvalidInput,
                  "{}: by its name it belongs to none of the clouds {}; import them one by one",
                  image.string(), NamesOf(sources.groups));
    owner->images.push_back(image);
  }
  return {};
}

Result<Sources> Sort(std::span<const Path> paths) {
  Sources sources;
  for (const Path& path : paths) FORESIGHT_CHECK(AddSource(path, sources));
  if (sources.groups.empty())
    return Fail(ErrorCode::kInvalidInput, "there is no cloud among the files to import");
  FORESIGHT_CHECK(ShareImages(sources));
  return sources;
}

Result<ColorImage> ReadColor(const Path& path) {
  if (HasExtension(path, {".png"})) return ReadPng(path);
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  return DecodeJpeg(bytes, path.string());
}

/// When the file was written: nothing else says when it was measured.
std::int64_t WrittenUtc_ns(const Path& path) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(path, error);
  if (error) return NowUtc_ns();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::file_clock::to_sys(time).time_since_epoch())
      .count();
}

class Importer {
 public:
  Importer(MissionFile& mission, const Sources& sources, ImportOptions options)
      : mission_(mission), sources_(sources), options_(std::move(options)) {}

  Result<ImportReport> Run(const RunContext& context) {
    const auto all = static_cast<double>(sources_.groups.size());
    double done = 0.0;
    for (const Group& group : sources_.groups) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the import was cancelled");
      const RunContext part = context.Part(done / all, (done + 1.0) / all);
      done += 1.0;
      part.Report(0.0, "importing clouds");
      if (HasExtension(group.cloud, {".bag"})) {
        if (!group.images.empty())
          return Fail(ErrorCode::kInvalidInput, "{}: a bag has images of its own; leave out {}",
                      group.cloud.string(), group.images.front().string());
        FORESIGHT_CHECK(ImportBag(
            group.cloud, options_, [&](ImportedScan scan) { return Keep(scan, group.cloud); },
            part));
        continue;
      }
      FORESIGHT_TRY(ScanParts parts, PartsOf(group));
      const bool time_known = parts.record.has_value();
      FORESIGHT_TRY(ImportedScan scan, AssembleScan(std::move(parts), options_));
      if (scan.scan.start_utc_ns == 0 && !time_known) {
        scan.scan.start_utc_ns = WrittenUtc_ns(group.cloud);
        scan.notes.emplace_back(
            "when it was measured is not in the file: the time at which the file was written "
            "stands for it");
      }
      FORESIGHT_CHECK(Keep(scan, group.cloud));
    }
    return std::move(report_);
  }

 private:
  Result<ScanParts> PartsOf(const Group& group) const {
    ScanParts parts;
    parts.name = group.name;
    FORESIGHT_TRY(parts.cloud, ReadCloudTable(group.cloud, options_.unit_m));
    if (!group.record.empty()) {
      FORESIGHT_TRY(const std::string json, ReadFile(group.record));
      FORESIGHT_TRY(parts.record, ScanRecordFromJson(json, group.record.string()));
    }
    for (const Path& image : group.images) {
      CameraFrame frame;
      frame.seq = static_cast<std::int64_t>(parts.images.size());
      FORESIGHT_TRY(frame.image, ReadColor(image));
      parts.images.push_back(std::move(frame));
    }
    if (!sources_.kitti.empty()) {
      FORESIGHT_TRY(const KittiCamera camera,
                    KittiCameraFrom(sources_.kitti, options_.kitti_camera, sources_.kitti_source));
      parts.camera = CameraOnCloud{camera.camera, camera.camera_from_velodyne};
      parts.viewpoint = Eigen::Vector3d::Zero();
    }
    return parts;
  }

  Status Keep(const ImportedScan& imported, const Path& file) {
    const Scan& scan = imported.scan;
    FORESIGHT_TRY(const std::int64_t id, mission_.BeginScan(scan));
    FORESIGHT_CHECK(mission_.SetGivenCloud(id, scan.given));
    for (const CameraFrame& frame : scan.frames) FORESIGHT_CHECK(mission_.AppendFrame(id, frame));
    FORESIGHT_CHECK(mission_.EndScan(id, ScanState::kComplete, ""));
    for (const ImportedPose& pose : imported.poses) FORESIGHT_CHECK(KeepPose(pose, id, scan.uuid));
    ImportReport::Entry entry{id,
                              scan.uuid,
                              imported.of_scan_uuid,
                              scan.source,
                              scan.given.lines,
                              scan.given.beams,
                              imported.points,
                              scan.frames.size(),
                              imported.grid,
                              imported.notes};
    FORESIGHT_CHECK(Tell(entry, file));
    report_.scans.push_back(std::move(entry));
    return {};
  }

  /// As a note: a robot is never sent what another program found.
  Status KeepPose(const ImportedPose& pose, std::int64_t scan_id, const std::string& scan_uuid) {
    NoteRecord note;
    note.scan_id = scan_id;
    note.scan_uuid = scan_uuid;
    note.kind = kNoteKind;
    note.utc_ns = pose.utc_ns;
    note.author = "import";
    note.text = pose.Text();
    note.tags = "pose imported";
    FORESIGHT_CHECK(mission_.AddNote(note));
    return {};
  }

  /// The mission's log says where a scan came from, and what was assumed.
  Status Tell(const ImportReport::Entry& entry, const Path& file) {
    const nlohmann::ordered_json json = {
        {"file", file.string()},  {"scan_uuid", entry.uuid}, {"of_scan_uuid", entry.of_scan_uuid},
        {"points", entry.points}, {"lines", entry.lines},    {"beams", entry.beams},
        {"grid", entry.grid}};
    const auto add = [&](const std::string& text, const std::string& more) -> Status {
      FORESIGHT_CHECK(mission_.AddEvent({0, NowUtc_ns(), "import", "info", text, more}));
      return {};
    };
    FORESIGHT_CHECK(add(
        fmt::format("scan {}: {}: {} points on a grid of {} lines of {} beams ({})", entry.scan_id,
                    entry.source, entry.points, entry.lines, entry.beams, entry.grid),
        json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
    for (const std::string& note : entry.notes)
      FORESIGHT_CHECK(add(fmt::format("scan {}: {}", entry.scan_id, note), ""));
    return {};
  }

  MissionFile& mission_;
  const Sources& sources_;
  const ImportOptions options_;
  ImportReport report_;
};

Result<ImportReport> ImportInto(const Path& part, const Sources& sources,
                                const ImportOptions& options, const RunContext& context) {
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission, MissionFile::Create(part));
  FORESIGHT_TRY(ImportReport report, Importer(*mission, sources, options).Run(context));
  FORESIGHT_CHECK(mission->Close());
  return report;
}

}  // namespace

Result<ImportReport> ImportMission(std::span<const std::filesystem::path> sources,
                                   const std::filesystem::path& target,
                                   const ImportOptions& options, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  if (IsThere(target))
    return Fail(ErrorCode::kIo, "{}: is there already; an import makes a new mission",
                target.string());
  FORESIGHT_TRY(const Path resolved, ResolveOutput(target));
  FORESIGHT_TRY(const Sources sorted, Sort(sources));
  ImportOptions with_rig = options;
  if (sorted.rig && options.rig)
    return Fail(ErrorCode::kInvalidInput, "there are two rigs: one among the files, one besides");
  if (sorted.rig) with_rig.rig = sorted.rig;
  if (with_rig.rig && !sorted.kitti.empty())
    return Fail(ErrorCode::kInvalidInput,
                "{}: a rig says where the camera is already; leave one of them out",
                sorted.kitti_source);
  const Path part = resolved.string() + ".part";
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  auto report = ImportInto(part, sorted, with_rig, context);
  if (!report) {
    for (const char* suffix : {"", "-wal", "-shm"})
      std::filesystem::remove(part.string() + suffix, ignored);
    return report;
  }
  FORESIGHT_CHECK(PublishFile(part, resolved));
  return report;
}

}  // namespace foresight
