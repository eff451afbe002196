#include "core/exchange/export_mission.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/atomic_file.h"
#include "core/calibration/camera_formats.h"
#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/exchange/mission_tables.h"
#include "core/exchange/paint_cloud.h"
#include "core/exchange/ros_bag.h"
#include "core/exchange/scan_record.h"
#include "core/exchange/vtk_files.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/registration/export_cloud.h"
#include "core/registration/grid_surface.h"

namespace foresight {
namespace {

using Path = std::filesystem::path;

constexpr std::pair<ExportPart, std::string_view> kNames[] = {
    {ExportPart::kPly, "ply"},
    {ExportPart::kPcd, "pcd"},
    {ExportPart::kVtp, "vtp"},
    {ExportPart::kSurfacePly, "surface-ply"},
    {ExportPart::kSurfaceObj, "surface-obj"},
    {ExportPart::kSurfaceGltf, "surface-gltf"},
    {ExportPart::kDepthPng, "depth-png"},
    {ExportPart::kDepthPfm, "depth-pfm"},
    {ExportPart::kVti, "vti"},
    {ExportPart::kImages, "images"},
    {ExportPart::kCamera, "camera"},
    {ExportPart::kTables, "tables"},
    {ExportPart::kBag, "bag"},
};

Status MakeFolder(const Path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error))
    return Fail(ErrorCode::kIo, "{}: the folder cannot be made: {}", folder.string(),
                error ? error.message() : "something else has this name");
  return {};
}

/// What the mask keeps, in millimetres; what does not fit into 16 bits is left out.
Image<std::uint16_t> MaskedMillimetres(const DepthResult& depth) {
  Image<std::uint16_t> out(depth.dense.depth_m.width(), depth.dense.depth_m.height());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double depth_mm = std::round(1000.0 * depth.dense.depth_m.values()[i]);
    const bool kept = depth.mask.values()[i] != 0 && depth_mm >= 1.0 && depth_mm <= 65535.0;
    out.values()[i] = kept ? static_cast<std::uint16_t>(depth_mm) : std::uint16_t{0};
  }
  return out;
}

class Exporter {
 public:
  Exporter(const MissionFile& mission, const Path& folder, const MissionExportOptions& options)
      : mission_(mission), folder_(folder), options_(options) {}

  Result<MissionExportReport> Run(const RunContext& context) {
    FORESIGHT_CHECK(MakeFolder(folder_));
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, WantedScans());
    if (Wants(ExportPart::kTables)) FORESIGHT_CHECK(WriteTables());
    if (Wants(ExportPart::kBag) && !scans.empty()) {
      FORESIGHT_TRY(RosBagWriter bag, RosBagWriter::Create(folder_ / "mission.bag"));
      bag_.emplace(std::move(bag));
    }
    const auto all = static_cast<double>(std::max<std::size_t>(1, scans.size()));
    double done = 0.0;
    for (const ScanSummary& scan : scans) {
      FORESIGHT_CHECK(WriteScan(scan, context.Part(done / all, (done + 1.0) / all)));
      done += 1.0;
    }
    if (bag_) {
      FORESIGHT_CHECK(bag_->Finish());
      report_.files.emplace_back("mission.bag");
    }
    return std::move(report_);
  }

 private:
  bool Wants(ExportPart part) const {
    return std::find(options_.parts.begin(), options_.parts.end(), part) != options_.parts.end();
  }
  bool WantsAny(std::initializer_list<ExportPart> parts) const {
    return std::any_of(parts.begin(), parts.end(), [this](ExportPart part) { return Wants(part); });
  }

  Result<std::vector<ScanSummary>> WantedScans() const {
    FORESIGHT_TRY(std::vector<ScanSummary> scans, mission_.ListScans());
    if (options_.scans.empty()) return scans;
    std::vector<ScanSummary> wanted;
    for (const std::int64_t id : options_.scans) {
      const auto at = std::find_if(scans.begin(), scans.end(),
                                   [id](const ScanSummary& scan) { return scan.id == id; });
      if (at == scans.end())
        return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", mission_.path().string(),
                    id);
      wanted.push_back(*at);
    }
    return wanted;
  }

  /// Writes a file below the folder with `write(path)`, and notes it.
  template <class Write>
  Status Put(const Path& file, const Write& write) {
    FORESIGHT_CHECK(write(folder_ / file));
    report_.files.push_back(file);
    return {};
  }
  Status PutText(const Path& file, const std::string& text) {
    return Put(file, [&](const Path& path) { return WriteFileAtomically(path, text); });
  }

  Status WriteTables() {
    FORESIGHT_TRY(const std::string scans, ScansCsv(mission_));
    FORESIGHT_TRY(const std::string detections, DetectionsCsv(mission_));
    FORESIGHT_TRY(const std::string notes, NotesCsv(mission_));
    FORESIGHT_TRY(const std::string events, EventsCsv(mission_));
    FORESIGHT_CHECK(PutText("scans.csv", scans));
    FORESIGHT_CHECK(PutText("detections.csv", detections));
    FORESIGHT_CHECK(PutText("notes.csv", notes));
    return PutText("events.csv", events);
  }

  void LeaveOut(const ScanSummary& scan, const std::string& what, const Error& error) {
    report_.left_out.push_back(fmt::format("scan {}: {}: {}", scan.id, what, error.message));
  }

  Status WriteScan(const ScanSummary& summary, const RunContext& context) {
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the export was cancelled");
    FORESIGHT_TRY(const Scan scan, mission_.LoadScan(summary.id));
    const Path sub = fmt::format("scan-{:04}", summary.id);
    if (WantsAny({ExportPart::kPly, ExportPart::kPcd, ExportPart::kVtp, ExportPart::kSurfacePly,
                  ExportPart::kSurfaceObj, ExportPart::kSurfaceGltf, ExportPart::kDepthPng,
                  ExportPart::kDepthPfm, ExportPart::kVti, ExportPart::kImages,
                  ExportPart::kCamera}))
      FORESIGHT_CHECK(MakeFolder(folder_ / sub));
    if (Wants(ExportPart::kImages)) FORESIGHT_CHECK(WriteImages(scan, sub));
    if (Wants(ExportPart::kCamera)) FORESIGHT_CHECK(WriteCamera(summary, scan, sub));
    if (!WantsAny({ExportPart::kPly, ExportPart::kPcd, ExportPart::kVtp, ExportPart::kSurfacePly,
                   ExportPart::kSurfaceObj, ExportPart::kSurfaceGltf, ExportPart::kDepthPng,
                   ExportPart::kDepthPfm, ExportPart::kVti, ExportPart::kBag}))
      return {};
    const auto cloud = RegisterScan(scan, context.Part(0.0, 0.1));
    if (!cloud) {
      if (cloud.error().code == ErrorCode::kCancelled) return tl::unexpected(cloud.error());
      LeaveOut(summary, "cloud and depth maps", cloud.error());
      return {};
    }
    std::vector<CloudPoint> points = PointsInRobot(*cloud, scan);
    FORESIGHT_CHECK(WriteDepths(summary, scan, *cloud, points, sub, context.Part(0.1, 0.8)));
    FORESIGHT_CHECK(WriteClouds(scan, points, sub));
    FORESIGHT_CHECK(WriteSurfaces(summary, *cloud, points, sub));
    const std::string record = ScanRecordToJson(scan, *cloud);
    if (WantsAny({ExportPart::kPly, ExportPart::kPcd}))
      FORESIGHT_CHECK(PutText(sub / "scan.json", record));
    if (bag_) FORESIGHT_CHECK(AddToBag(summary, scan, points, record, context.Part(0.9, 1.0)));
    return {};
  }

  Status WriteImages(const Scan& scan, const Path& sub) {
    for (std::size_t i = 0; i < scan.frames.size(); ++i)
      FORESIGHT_CHECK(Put(sub / fmt::format("image-{}.png", i), [&](const Path& path) {
        return WritePng(path, scan.frames[i].image, PngContent::kCapture);
      }));
    return {};
  }

  Status WriteCamera(const ScanSummary& summary, const Scan& scan, const Path& sub) {
    FORESIGHT_CHECK(
        Put(sub / "rig.yaml", [&](const Path& path) { return SaveSensorRig(scan.rig, path); }));
    for (const auto& [format, name] : {std::pair(CameraFormat::kOpenCv, "camera-opencv.yaml"),
                                       std::pair(CameraFormat::kRos, "camera-ros.yaml"),
                                       std::pair(CameraFormat::kKalibr, "camchain-kalibr.yaml"),
                                       std::pair(CameraFormat::kColmap, "cameras.txt")}) {
      const auto camera = ExportCamera(scan.rig.camera, format);
      if (camera)
        FORESIGHT_CHECK(PutText(sub / name, camera->text));
      else
        LeaveOut(summary, name, camera.error());
    }
    return {};
  }

  Status WriteDepths(const ScanSummary& summary, const Scan& scan, const RegisteredScan& cloud,
                     std::vector<CloudPoint>& points, const Path& sub, const RunContext& context) {
    if (scan.frames.empty())
      report_.left_out.push_back(
          fmt::format("scan {}: it has no image, so no depth map and no colour", summary.id));
    const auto all = static_cast<double>(std::max<std::size_t>(1, scan.frames.size()));
    for (std::size_t i = 0; i < scan.frames.size(); ++i) {
      const auto at = static_cast<double>(i);
      const auto depth = ComputeDepthInFrame(cloud, scan.rig, scan.frames[i], options_.depth,
                                             context.Part(at / all, (at + 1.0) / all));
      if (!depth) {
        if (depth.error().code == ErrorCode::kCancelled) return tl::unexpected(depth.error());
        LeaveOut(summary, fmt::format("depth map of image {}", i), depth.error());
        continue;
      }
      PaintCloud(points, scan.frames[i], *depth);
      FORESIGHT_CHECK(WriteDepth(*depth, scan.frames[i].image, i, sub));
    }
    return {};
  }

  Status WriteDepth(const DepthResult& depth, const ColorImage& image, std::size_t i,
                    const Path& sub) {
    if (Wants(ExportPart::kDepthPng))
      FORESIGHT_CHECK(Put(sub / fmt::format("depth-{}.png", i), [&](const Path& path) {
        return WritePng16(path, MaskedMillimetres(depth));
      }));
    if (Wants(ExportPart::kVti))
      FORESIGHT_CHECK(Put(sub / fmt::format("depth-{}.vti", i),
                          [&](const Path& path) { return WriteVti(path, depth, image); }));
    if (!Wants(ExportPart::kDepthPfm)) return {};
    FloatImage depth_mm = depth.dense.depth_m;
    for (float& value : depth_mm.values()) value *= 1000.0f;
    FORESIGHT_CHECK(Put(sub / fmt::format("depth-{}.pfm", i),
                        [&](const Path& path) { return WritePfm(path, depth_mm); }));
    FORESIGHT_CHECK(Put(sub / fmt::format("confidence-{}.pfm", i),
                        [&](const Path& path) { return WritePfm(path, depth.dense.confidence); }));
    return Put(sub / fmt::format("mask-{}.png", i),
               [&](const Path& path) { return WritePng(path, depth.mask); });
  }

  Status WriteClouds(const Scan& scan, const std::vector<CloudPoint>& points, const Path& sub) {
    const CloudOrigin origin{"robot", scan.uuid, scan.start_utc_ns};
    if (Wants(ExportPart::kPly))
      FORESIGHT_CHECK(Put(sub / "cloud.ply", [&](const Path& path) {
        return WritePly(path, points, CloudFields::kWithImage, origin);
      }));
    if (Wants(ExportPart::kPcd))
      FORESIGHT_CHECK(Put(sub / "cloud.pcd", [&](const Path& path) {
        return WritePcd(path, points, CloudFields::kWithImage, origin);
      }));
    if (!Wants(ExportPart::kVtp)) return {};
    return Put(sub / "cloud.vtp", [&](const Path& path) { return WriteVtp(path, points); });
  }

  Status WriteSurfaces(const ScanSummary& summary, const RegisteredScan& cloud,
                       const std::vector<CloudPoint>& points, const Path& sub) {
    constexpr std::pair<ExportPart, const char*> kFiles[] = {
        {ExportPart::kSurfacePly, "surface.ply"},
        {ExportPart::kSurfaceObj, "surface.obj"},
        {ExportPart::kSurfaceGltf, "surface.gltf"}};
    if (!WantsAny({ExportPart::kSurfacePly, ExportPart::kSurfaceObj, ExportPart::kSurfaceGltf}))
      return {};
    const auto triangles = GridSurface(cloud, {});
    if (!triangles) {
      LeaveOut(summary, "surface", triangles.error());
      return {};
    }
    for (const auto& [part, name] : kFiles)
      if (Wants(part))
        FORESIGHT_CHECK(Put(
            sub / name, [&](const Path& path) { return WriteSurface(path, points, *triangles); }));
    return {};
  }

  Status AddToBag(const ScanSummary& summary, const Scan& scan,
                  const std::vector<CloudPoint>& points, const std::string& scan_record,
                  const RunContext& context) {
    FORESIGHT_TRY(const std::vector<DetectionRecord> records, mission_.ListDetections(summary.id));
    std::vector<BagObject> objects;
    for (const DetectionRecord& record : records) {
      const auto detection = DetectionFromJson(record.json);
      if (record.deleted || !detection || CandidateCount(*detection) == 0) continue;
      objects.push_back(
          {record.kind, record.utc_ns, scan.rig.robot_from_base * CandidatePose(*detection, 0)});
    }
    return bag_->Add({scan, points, scan_record, objects}, context);
  }

  const MissionFile& mission_;
  const Path& folder_;
  const MissionExportOptions& options_;
  std::optional<RosBagWriter> bag_;
  MissionExportReport report_;
};

}  // namespace

std::string_view ToString(ExportPart part) {
  for (const auto& [value, name] : kNames)
    if (value == part) return name;
  return "";
}

Result<ExportPart> ExportPartFromText(std::string_view text) {
  std::string all;
  for (const auto& [value, name] : kNames) {
    if (name == text) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  return Fail(ErrorCode::kInvalidOptions, "'{}' cannot be exported; these can: {}", text, all);
}

Result<MissionExportReport> ExportMission(const MissionFile& mission,
                                          const std::filesystem::path& folder,
                                          const MissionExportOptions& options,
                                          const RunContext& context) {
  return Exporter(mission, folder, options).Run(context);
}

}  // namespace foresight
