#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/run_context.h"
#include "core/depth/pipeline.h"
#include "core/mission/mission_file.h"

namespace foresight {

/// What can be written of a mission for other programs.
enum class ExportPart {
  kPly,          ///< cloud.ply
  kPcd,          ///< cloud.pcd
  kVtp,          ///< cloud.vtp, for ParaView
  kSurfacePly,   ///< surface.ply: the measured grid as triangles
  kSurfaceObj,   ///< surface.obj
  kSurfaceGltf,  ///< surface.gltf
  kDepthPng,     ///< depth-N.png: 16 bit, millimetres, what the mask keeps; 0 = nothing
  kDepthPfm,     ///< depth-N.pfm (millimetres, NaN = none), confidence-N.pfm, mask-N.png
  kVti,          ///< depth-N.vti, for ParaView
  kImages,       ///< image-N.png
  kCamera,       ///< rig.yaml, and the camera for OpenCV, ROS, Kalibr and COLMAP
  kTables,       ///< scans.csv, detections.csv, events.csv
  kBag,          ///< mission.bag: ROS 1, for RViz and Foxglove
};
inline constexpr std::array kExportParts = {
    ExportPart::kPly,        ExportPart::kPcd,        ExportPart::kVtp,
    ExportPart::kSurfacePly, ExportPart::kSurfaceObj, ExportPart::kSurfaceGltf,
    ExportPart::kDepthPng,   ExportPart::kDepthPfm,   ExportPart::kVti,
    ExportPart::kImages,     ExportPart::kCamera,     ExportPart::kTables,
    ExportPart::kBag};
/// "ply", "surface-gltf", "depth-png", ...
std::string_view ToString(ExportPart part);
/// The reverse; fails with kInvalidOptions, naming all.
Result<ExportPart> ExportPartFromText(std::string_view text);

struct MissionExportOptions {
  std::vector<ExportPart> parts = {kExportParts.begin(), kExportParts.end()};
  std::vector<std::int64_t> scans;  ///< empty = all
  DepthOptions depth;               ///< of the depth maps and of the points' confidence
};

struct MissionExportReport {
  std::vector<std::filesystem::path> files;  ///< from `folder`, in the order of writing
  std::vector<std::string> left_out;         ///< one sentence each: a scan without an image, ...
};

/// Writes parts of a mission into `folder`, which is made where it is missing: tables and bag
/// there, and what belongs to a scan in `scan-NNNN` below it. Clouds are in robot, metres.
/// Exporting again gives the same bytes. Fails with kInvalidInput for a scan that is not there,
/// with kIo, kBadData (a damaged mission) and kCancelled.
Result<MissionExportReport> ExportMission(const MissionFile& mission,
                                          const std::filesystem::path& folder,
                                          const MissionExportOptions& options,
                                          const RunContext& context);

}  // namespace foresight
