#include "core/exchange/bag_file.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <exception>

namespace foresight {
namespace {

ros::Time RosTime(BagTime_ns time_ns) {
  constexpr BagTime_ns kSecond_ns = 1'000'000'000;
  const BagTime_ns clamped = std::max<BagTime_ns>(1, time_ns);
  ros::Time time;
  time.sec = static_cast<std::uint32_t>(clamped / kSecond_ns);
  time.nsec = static_cast<std::uint32_t>(clamped % kSecond_ns);
  return time;
}

/// The library's exceptions end here.
template <class Body>
std::string Guard(const Body& body) {
  try {
    body();
    return {};
  } catch (const std::exception& failure) {
    return std::string(failure.what()).empty() ? "the bag could not be written" : failure.what();
  }
}

template <class Message>
Message Stamped(const std::string& frame, BagTime_ns time) {
  Message message;
  message.header.stamp = RosTime(time);
  message.header.frame_id = frame;
  return message;
}

template <class Rotation>
void SetRotation(const BagPose& pose, Rotation& rotation) {
  rotation.w = pose.rotation_wxyz[0];
  rotation.x = pose.rotation_wxyz[1];
  rotation.y = pose.rotation_wxyz[2];
  rotation.z = pose.rotation_wxyz[3];
}

template <class Position>
void SetPosition(const BagPose& pose, Position& position) {
  position.x = pose.position_m[0];
  position.y = pose.position_m[1];
  position.z = pose.position_m[2];
}

void AddField(const BagField& field, sensor_msgs::PointCloud2& cloud) {
  using Field = sensor_msgs::PointField;
  Field added;
  added.name = field.name;
  added.offset = cloud.point_step;
  added.count = 1;
  switch (field.type) {
    case BagField::Type::kInt32:
      added.datatype = Field::INT32;
      break;
    case BagField::Type::kFloat32:
      added.datatype = Field::FLOAT32;
      break;
    case BagField::Type::kFloat64:
      added.datatype = Field::FLOAT64;
      break;
  }
  cloud.point_step += field.type == BagField::Type::kFloat64 ? 8 : 4;
  cloud.fields.push_back(added);
}

}  // namespace

struct BagFile::Impl {
  rosbag::Bag bag;
};

BagFile::BagFile() : impl_(std::make_unique<Impl>()) {}

BagFile::~BagFile() {
  (void)Close();  // who wants to know has closed it
}

std::string BagFile::Open(const std::string& path) {
  return Guard([&] { impl_->bag.open(path, rosbag::bagmode::Write); });
}

std::string BagFile::WriteCloud(const std::string& topic, BagTime_ns time, const BagCloud& cloud) {
  return Guard([&] {
    auto message = Stamped<sensor_msgs::PointCloud2>(cloud.frame, time);
    message.height = 1;
    message.width = cloud.points;
    message.is_dense = true;
    for (const BagField& field : cloud.fields) AddField(field, message);
    message.row_step = message.point_step * message.width;
    message.data = cloud.data;
    impl_->bag.write(topic, RosTime(time), message);
  });
}

std::string BagFile::WriteImage(const std::string& topic, BagTime_ns time, const BagImage& image) {
  return Guard([&] {
    auto message = Stamped<sensor_msgs::Image>(image.frame, time);
    message.width = image.width;
    message.height = image.height;
    message.encoding = image.channels == 1 ? "mono8" : "rgb8";
    message.step = image.width * static_cast<std::uint32_t>(image.channels);
    message.data = image.data;
    impl_->bag.write(topic, RosTime(time), message);
  });
}

std::string BagFile::WriteCamera(const std::string& topic, BagTime_ns time,
                                 const BagCamera& camera) {
  return Guard([&] {
    auto message = Stamped<sensor_msgs::CameraInfo>(camera.frame, time);
    message.width = camera.width;
    message.height = camera.height;
    message.distortion_model = camera.distortion_model;
    message.D = camera.distortion;
    const double fx = camera.fx, fy = camera.fy, cx = camera.cx, cy = camera.cy;
    message.K = {fx, 0, cx, 0, fy, cy, 0, 0, 1};
    message.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    message.P = {fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0};
    impl_->bag.write(topic, RosTime(time), message);
  });
}

std::string BagFile::WriteTransforms(const std::string& topic, BagTime_ns time,
                                     const std::vector<BagPose>& poses) {
  return Guard([&] {
    tf2_msgs::TFMessage message;
    for (const BagPose& pose : poses) {
      auto transform = Stamped<geometry_msgs::TransformStamped>(pose.frame, time);
      transform.child_frame_id = pose.child;
      SetPosition(pose, transform.transform.translation);
      SetRotation(pose, transform.transform.rotation);
      message.transforms.push_back(transform);
    }
    impl_->bag.write(topic, RosTime(time), message);
  });
}

std::string BagFile::WritePose(const std::string& topic, BagTime_ns time, const BagPose& pose) {
  return Guard([&] {
    auto message = Stamped<geometry_msgs::PoseStamped>(pose.frame, time);
    SetPosition(pose, message.pose.position);
    SetRotation(pose, message.pose.orientation);
    impl_->bag.write(topic, RosTime(time), message);
  });
}

std::string BagFile::Close() {
  return Guard([&] { impl_->bag.close(); });
}

}  // namespace foresight
