#pragma once

// ROS's message headers are not C++20 (they use std::allocator<void>::rebind), so bag_file.cpp is
// compiled as C++17, and this header includes nothing of ours.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace foresight {

/// Nanoseconds since 1970; a time before is written as 1 ns after it: ROS has none earlier.
using BagTime_ns = std::int64_t;

/// One value of a point in BagCloud::data.
struct BagField {
  enum class Type { kInt32, kFloat32, kFloat64 };
  std::string name;
  Type type = Type::kFloat32;
};

/// sensor_msgs/PointCloud2: points one after the other, little-endian, their fields packed.
struct BagCloud {
  std::string frame;
  std::vector<BagField> fields;
  std::uint32_t points = 0;
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/Image, encoding rgb8, or mono8 where `channels` is 1.
struct BagImage {
  std::string frame;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int channels = 3;
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/CameraInfo.
struct BagCamera {
  std::string frame;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string distortion_model;
  std::vector<double> distortion;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// A pose: of geometry_msgs/TransformStamped (child in frame) or geometry_msgs/PoseStamped.
struct BagPose {
  std::string frame;
  std::string child;
  std::array<double, 3> position_m = {};
  std::array<double, 4> rotation_wxyz = {1.0, 0.0, 0.0, 0.0};
};

/// A ROS 1 bag that is being written. Every call answers with what failed, empty = nothing.
class BagFile {
 public:
  BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;
  ~BagFile();

  std::string Open(const std::string& path);
  std::string WriteCloud(const std::string& topic, BagTime_ns time, const BagCloud& cloud);
  std::string WriteImage(const std::string& topic, BagTime_ns time, const BagImage& image);
  std::string WriteCamera(const std::string& topic, BagTime_ns time, const BagCamera& camera);
  std::string WriteTransforms(const std::string& topic, BagTime_ns time,
                              const std::vector<BagPose>& poses);
  std::string WritePose(const std::string& topic, BagTime_ns time, const BagPose& pose);
  std::string Close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
