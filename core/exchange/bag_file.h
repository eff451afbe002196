#pragma once

// ROS's message headers are not C++20 (they use std::allocator<void>::rebind), so bag_file.cpp is
// compiled as C++17, and this header includes nothing of ours.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
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

/// What a bag has under one name.
struct BagTopic {
  std::string name;
  std::string type;               ///< "sensor_msgs/PointCloud2"
  std::vector<BagTime_ns> times;  ///< when its messages were recorded, in order
};

/// sensor_msgs/PointCloud2 as it is read.
struct BagCloudMessage {
  struct Field {
    std::string name;
    std::uint32_t offset = 0;
    std::uint8_t type = 0;  ///< sensor_msgs/PointField's number
    std::uint32_t count = 0;
  };
  std::string frame;
  BagTime_ns time = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  bool big_endian = false;
  std::vector<Field> fields;
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/Image or, with an `encoding` of "jpeg" or "png" and no size, CompressedImage.
struct BagImageMessage {
  std::string frame;
  BagTime_ns time = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t step = 0;
  std::string encoding;
  std::vector<std::uint8_t> data;
};

/// A ROS 1 bag that is read. Every call answers with what failed, empty = nothing. `number` counts
/// the messages of a topic from 0.
class BagReader {
 public:
  BagReader();
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;
  ~BagReader();

  std::string Open(const std::string& path);
  std::string ReadTopics(std::vector<BagTopic>* topics);
  std::string ReadCloud(const std::string& topic, std::size_t number, BagCloudMessage* message);
  std::string ReadImage(const BagTopic& topic, std::size_t number, BagImageMessage* message);
  /// The topic's last one that was recorded no later than `time`, or the first one.
  std::string ReadCamera(const std::string& topic, BagTime_ns time, BagCamera* camera);
  /// std_msgs/String.
  std::string ReadText(const std::string& topic, std::size_t number, std::string* text);
  /// tf2_msgs/TFMessage and tf/tfMessage: all transforms with their times.
  std::string ReadTransforms(const std::string& topic,
                             std::vector<std::pair<BagTime_ns, BagPose>>* poses);
  /// geometry_msgs/PoseStamped: the first `most` of the topic with their times, without a child.
  std::string ReadPoses(const std::string& topic, std::size_t most,
                        std::vector<std::pair<BagTime_ns, BagPose>>* poses);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
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
  /// std_msgs/String.
  std::string WriteText(const std::string& topic, BagTime_ns time, const std::string& text);
  std::string WritePose(const std::string& topic, BagTime_ns time, const BagPose& pose);
  std::string Close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
