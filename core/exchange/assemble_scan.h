#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/exchange/scan_record.h"
#include "core/geometry/angles.h"
#include "core/io/cloud_table.h"

namespace foresight {

/// In which frame an imported cloud's points are.
enum class CloudFrame { kRobot, kBase, kLidar, kCamera };
/// "robot", "base", "lidar", "camera"; fails with kInvalidOptions.
Result<CloudFrame> CloudFrameFromText(std::string_view text);

/// A camera that nothing was taken with, for clouds without an image: its image is grey, so a depth
/// map is made of the points alone.
struct BlankView {
  double azimuth_rad = 0.0;                     ///< to the left of ahead
  double elevation_rad = 0.0;                   ///< up
  double field_rad = RadiansFromDegrees(90.0);  ///< across the width, below 170 deg
  int width = 640;
  int height = 480;

  Status Check() const;
};

/// How a cloud is taken; what is empty is taken from the files, or assumed and said.
struct ImportOptions {
  std::optional<SensorRig> rig;
  std::optional<CloudFrame> frame;
  std::optional<Eigen::Vector3d> viewpoint;       ///< in the cloud's frame, metres
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< in the cloud's frame; without a rig
  double unit_m = 1.0;                            ///< of a file's coordinates; 3DTK's know theirs
  std::vector<double> image_angles_rad;           ///< of the motor, of the images in their order
  std::optional<BlankView> view;
  int kitti_camera = 2;
  std::string cloud_topic;  ///< of a bag with several
  std::string image_topic;
  std::vector<int> clouds;  ///< of a bag, from 1; empty = all

  Status Check() const;
};

/// A camera whose place in the cloud's frame is known.
struct CameraOnCloud {
  CameraModel camera;                                    ///< width 0: that of the image
  Rigid<frame::Camera, frame::Robot> camera_from_cloud;  ///< the cloud's frame in place of robot
};

/// What is put together to a scan.
struct ScanParts {
  std::string name;  ///< of the file, for its source
  CloudTable cloud;  ///< in metres
  std::vector<CameraFrame> images;
  std::optional<ScanRecord> record;
  std::optional<CameraOnCloud> camera;
  std::optional<Eigen::Vector3d> viewpoint;  ///< as the file knows it; options go first
  /// How the robot's frame lies in the cloud's, where the file knows it (tf).
  std::optional<Eigen::Matrix4d> robot_from_cloud;
  std::optional<std::int64_t> start_utc_ns;
};

/// A pose that another program told beside a cloud: of what it found, or of the robot. What it is
/// and how certain is not known, so it is kept as a note and is no detection.
struct ImportedPose {
  std::string name;   ///< of its topic
  std::string frame;  ///< as its program calls it
  std::int64_t utc_ns = 0;
  std::array<double, 3> position_m = {};                       ///< in `frame`, finite
  std::array<double, 4> rotation_wxyz = {1.0, 0.0, 0.0, 0.0};  ///< likewise

  /// One line with every digit: "/goal: a pose in 'map', position (1, 2, 0) m, quaternion
  /// (w, x, y, z) (1, 0, 0, 0)".
  std::string Text() const;
};

struct ImportedScan {
  Scan scan;                 ///< with a given cloud, complete
  std::string of_scan_uuid;  ///< the exported scan that it is a copy of; empty = not known
  std::size_t points = 0;
  std::string grid;                ///< in words, how its grid was found
  std::vector<std::string> notes;  ///< what was assumed, lost, or does not work, a sentence each
  std::vector<ImportedPose> poses;
};

/// Puts a scan together. Fails with kInvalidInput where parts do not fit each other (an image of
/// another size than its camera's), kInvalidOptions and kBadData.
Result<ImportedScan> AssembleScan(ScanParts parts, const ImportOptions& options);

}  // namespace foresight
