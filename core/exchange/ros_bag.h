#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/io/point_cloud_file.h"
#include "core/sensor/scan.h"

namespace foresight {

/// A pose of something found, for a bag.
struct BagObject {
  std::string kind;  ///< topic /foresight/objects/KIND
  std::int64_t utc_ns = 0;
  Rigid<frame::Robot, frame::Object> robot_from_object;
};

/// One scan as a bag gets it. Nothing is owned.
struct BagScan {
  const Scan& scan;
  std::span<const CloudPoint> points;  ///< in robot
  std::string record;                  ///< ScanRecordToJson: what the other messages do not say
  std::span<const BagObject> objects;
};

/// Writes a ROS 1 bag (format 2.0), which RViz and Foxglove open: /foresight/cloud (PointCloud2 in
/// `robot`, a scan a message: x y z intensity line beam time rgb confidence),
/// /foresight/camera/image (Image, rgb8, frame `camera`), /foresight/camera/camera_info, /tf (base
/// to head, with each image and each tenth motor sample), /tf_static (robot to base, head to camera
/// and lidar), /foresight/scan (std_msgs/String, JSON: the record), and /foresight/objects/KIND
/// (PoseStamped in `robot`). Times are UTC. A camera model
/// that ROS has no name for is refitted to equidistant (ExportCamera). The same scans give the same
/// bytes. Writes the whole file or nothing; fails with kIo, as ExportCamera does, and with
/// kCancelled.
class RosBagWriter {
 public:
  static Result<RosBagWriter> Create(const std::filesystem::path& path);
  RosBagWriter(RosBagWriter&&) noexcept;
  RosBagWriter& operator=(RosBagWriter&&) = delete;
  /// Without Finish nothing is left.
  ~RosBagWriter();

  /// Scans in the order of their times.
  Status Add(const BagScan& scan, const RunContext& context);
  /// Gives the file its name.
  Status Finish();

 private:
  struct Impl;
  explicit RosBagWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
