#include "core/exchange/bag_file.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "core/exchange/bag_check.h"

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
  // Who wants to know has closed it. A bag that cannot be closed, as on a full disk, is let go of:
  // its destructor would try once more, and an exception there ends the program.
  if (!Close().empty()) (void)impl_.release();
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

std::string BagFile::WriteText(const std::string& topic, BagTime_ns time, const std::string& text) {
  return Guard([&] {
    std_msgs::String message;
    message.data = text;
    impl_->bag.write(topic, RosTime(time), message);
  });
}

std::string BagFile::Close() {
  return Guard([&] { impl_->bag.close(); });
}

namespace {

BagTime_ns TimeOf(const ros::Time& time) {
  return static_cast<BagTime_ns>(time.sec) * 1'000'000'000 + static_cast<BagTime_ns>(time.nsec);
}

/// A header without a stamp has the time at which the message was recorded.
BagTime_ns StampOf(const std_msgs::Header& header, const ros::Time& recorded) {
  return header.stamp.isZero() ? TimeOf(recorded) : TimeOf(header.stamp);
}

template <class Message>
typename Message::ConstPtr Decoded(const rosbag::MessageInstance& instance) {
  const typename Message::ConstPtr message = instance.instantiate<Message>();
  if (!message)
    throw std::runtime_error("a message of " + instance.getTopic() + " is a " +
                             instance.getDataType());
  return message;
}

/// Calls `take` with the topic's message of that number.
template <class Take>
void AtMessage(rosbag::Bag& bag, const std::string& topic, std::size_t number, const Take& take) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::size_t at = 0;
  for (const rosbag::MessageInstance& instance : view)
    if (at++ == number) return take(instance);
  throw std::runtime_error(topic + " has no message " + std::to_string(number + 1));
}

BagPose PoseFrom(const geometry_msgs::TransformStamped& stamped) {
  const auto& t = stamped.transform.translation;
  const auto& q = stamped.transform.rotation;
  // Older programs wrote "/base".
  const auto name = [](const std::string& frame) {
    return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  };
  return {name(stamped.header.frame_id),
          name(stamped.child_frame_id),
          {t.x, t.y, t.z},
          {q.w, q.x, q.y, q.z}};
}

}  // namespace

struct BagReader::Impl {
  rosbag::Bag bag;
};

BagReader::BagReader() : impl_(std::make_unique<Impl>()) {}

BagReader::~BagReader() {
  (void)Guard([&] { impl_->bag.close(); });
}

std::string BagReader::Open(const std::string& path) {
  std::string damage = CheckBag(path);
  if (!damage.empty()) return damage;
  return Guard([&] { impl_->bag.open(path, rosbag::bagmode::Read); });
}

std::string BagReader::ReadTopics(std::vector<BagTopic>* topics) {
  return Guard([&] {
    rosbag::View view(impl_->bag);
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      const bool known = std::any_of(topics->begin(), topics->end(), [&](const BagTopic& topic) {
        return topic.name == connection->topic;
      });
      if (!known) topics->push_back({connection->topic, connection->datatype, {}});
    }
    for (const rosbag::MessageInstance& instance : view)
      for (BagTopic& topic : *topics)
        if (topic.name == instance.getTopic()) topic.times.push_back(TimeOf(instance.getTime()));
  });
}

std::string BagReader::ReadCloud(const std::string& topic, std::size_t number,
                                 BagCloudMessage* message) {
  return Guard([&] {
    AtMessage(impl_->bag, topic, number, [&](const rosbag::MessageInstance& instance) {
      const auto cloud = Decoded<sensor_msgs::PointCloud2>(instance);
      message->frame = cloud->header.frame_id;
      message->time = StampOf(cloud->header, instance.getTime());
      message->width = cloud->width;
      message->height = cloud->height;
      message->point_step = cloud->point_step;
      message->row_step = cloud->row_step;
      message->big_endian = cloud->is_bigendian != 0;
      for (const auto& field : cloud->fields)
        message->fields.push_back({field.name, field.offset, field.datatype, field.count});
      message->data = cloud->data;
    });
  });
}

std::string BagReader::ReadImage(const BagTopic& topic, std::size_t number,
                                 BagImageMessage* message) {
  return Guard([&] {
    AtMessage(impl_->bag, topic.name, number, [&](const rosbag::MessageInstance& instance) {
      if (topic.type == "sensor_msgs/CompressedImage") {
        const auto image = Decoded<sensor_msgs::CompressedImage>(instance);
        message->frame = image->header.frame_id;
        message->time = StampOf(image->header, instance.getTime());
        message->encoding = image->format.find("png") != std::string::npos ? "png" : "jpeg";
        message->data = image->data;
        return;
      }
      const auto image = Decoded<sensor_msgs::Image>(instance);
      message->frame = image->header.frame_id;
      message->time = StampOf(image->header, instance.getTime());
      message->width = image->width;
      message->height = image->height;
      message->step = image->step;
      message->encoding = image->encoding;
      message->data = image->data;
    });
  });
}

std::string BagReader::ReadCamera(const std::string& topic, BagTime_ns time, BagCamera* camera) {
  return Guard([&] {
    rosbag::View view(impl_->bag, rosbag::TopicQuery(topic));
    bool any = false;
    for (const rosbag::MessageInstance& instance : view) {
      if (any && TimeOf(instance.getTime()) > time) break;
      const auto info = Decoded<sensor_msgs::CameraInfo>(instance);
      any = true;
      *camera = {info->header.frame_id,
                 info->width,
                 info->height,
                 info->distortion_model,
                 info->D,
                 info->K[0],
                 info->K[4],
                 info->K[2],
                 info->K[5]};
    }
    if (!any) throw std::runtime_error(topic + " has no message");
  });
}

std::string BagReader::ReadText(const std::string& topic, std::size_t number, std::string* text) {
  return Guard([&] {
    AtMessage(impl_->bag, topic, number, [&](const rosbag::MessageInstance& instance) {
      *text = Decoded<std_msgs::String>(instance)->data;
    });
  });
}

std::string BagReader::ReadTransforms(const std::string& topic,
                                      std::vector<std::pair<BagTime_ns, BagPose>>* poses) {
  return Guard([&] {
    rosbag::View view(impl_->bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view) {
      // tf/tfMessage has the same bytes; the library knows it by another sum.
      const auto message = Decoded<tf2_msgs::TFMessage>(instance);
      for (const auto& transform : message->transforms)
        poses->emplace_back(StampOf(transform.header, instance.getTime()), PoseFrom(transform));
    }
  });
}

std::string BagReader::ReadPoses(const std::string& topic, std::size_t most,
                                 std::vector<std::pair<BagTime_ns, BagPose>>* poses) {
  return Guard([&] {
    rosbag::View view(impl_->bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view) {
      if (poses->size() >= most) break;
      const auto message = Decoded<geometry_msgs::PoseStamped>(instance);
      const auto& p = message->pose.position;
      const auto& q = message->pose.orientation;
      poses->emplace_back(
          StampOf(message->header, instance.getTime()),
          BagPose{message->header.frame_id, {}, {p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}});
    }
  });
}

}  // namespace foresight
