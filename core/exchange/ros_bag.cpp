#include "core/exchange/ros_bag.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/calibration/camera_formats.h"

namespace foresight {
namespace {

ros::Time TimeOf(std::int64_t utc_ns) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  // ROS 1 has no time before 1970, nor 0 (it means "no time").
  const std::int64_t clamped = std::max<std::int64_t>(1, utc_ns);
  ros::Time time;
  time.sec = static_cast<std::uint32_t>(clamped / kSecond_ns);
  time.nsec = static_cast<std::uint32_t>(clamped % kSecond_ns);
  return time;
}

ros::Time TimeOf(const Scan& scan, double time_s) {
  return TimeOf(scan.start_utc_ns + static_cast<std::int64_t>(1e9 * time_s));
}

template <class To, class From>
geometry_msgs::TransformStamped TransformOf(const char* parent, const char* child,
                                            const Rigid<To, From>& parent_from_child,
                                            const ros::Time& time) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = time;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  const Eigen::Vector3d& t = parent_from_child.translation();
  const Eigen::Quaterniond& q = parent_from_child.rotation();
  message.transform.translation.x = t.x();
  message.transform.translation.y = t.y();
  message.transform.translation.z = t.z();
  message.transform.rotation.w = q.w();
  message.transform.rotation.x = q.x();
  message.transform.rotation.y = q.y();
  message.transform.rotation.z = q.z();
  return message;
}

void AddField(sensor_msgs::PointCloud2& cloud, const char* name, std::uint8_t type,
              std::uint32_t bytes) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = type;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += bytes;
}

sensor_msgs::PointCloud2 CloudOf(std::span<const CloudPoint> points, const ros::Time& time) {
  using Field = sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = time;
  cloud.header.frame_id = "robot";
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.is_dense = true;
  for (const char* name : {"x", "y", "z", "intensity"}) AddField(cloud, name, Field::FLOAT32, 4);
  for (const char* name : {"line", "beam"}) AddField(cloud, name, Field::INT32, 4);
  AddField(cloud, "time", Field::FLOAT64, 8);
  AddField(cloud, "rgb", Field::FLOAT32, 4);
  AddField(cloud, "confidence", Field::FLOAT32, 4);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* at = cloud.data.data();
  const auto put = [&at](const auto& value) {
    std::memcpy(at, &value, sizeof(value));
    at += sizeof(value);
  };
  for (const CloudPoint& point : points) {
    put(point.x);
    put(point.y);
    put(point.z);
    put(point.intensity);
    put(point.line);
    put(point.beam);
    put(point.time_s);
    put(static_cast<std::uint32_t>(point.color.r << 16 | point.color.g << 8 | point.color.b));
    put(point.confidence);
  }
  return cloud;
}

sensor_msgs::Image ImageOf(const CameraFrame& frame, const ros::Time& time) {
  sensor_msgs::Image image;
  image.header.stamp = time;
  image.header.frame_id = "camera";
  image.width = static_cast<std::uint32_t>(frame.image.width());
  image.height = static_cast<std::uint32_t>(frame.image.height());
  image.encoding = "rgb8";
  image.step = 3 * image.width;
  image.data.resize(std::size_t{image.step} * image.height);
  std::memcpy(image.data.data(), frame.image.data(), image.data.size());
  return image;
}

Result<sensor_msgs::CameraInfo> CameraInfoOf(const CameraModel& camera) {
  FORESIGHT_TRY(const CameraExport as_ros, ExportCamera(camera, CameraFormat::kRos));
  const CameraModel& c = as_ros.refit ? as_ros.refit->camera : camera;
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "camera";
  info.width = static_cast<std::uint32_t>(c.width);
  info.height = static_cast<std::uint32_t>(c.height);
  info.distortion_model = as_ros.model;
  if (const auto* kb4 = std::get_if<KannalaBrandtLens>(&c.lens)) {
    const auto k = kb4->Parameters();
    info.D.assign(k.begin(), k.end());
  } else if (const auto* radtan = std::get_if<RadialTangentialLens>(&c.lens)) {
    const auto k = radtan->Parameters();
    info.D.assign(k.begin(), k.end());
  } else {
    info.D.assign(5, 0.0);
  }
  info.K = {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {c.fx, 0, c.cx, 0, 0, c.fy, c.cy, 0, 0, 0, 1, 0};
  return info;
}

geometry_msgs::PoseStamped PoseOf(const BagObject& object) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = TimeOf(object.utc_ns);
  pose.header.frame_id = "robot";
  const Eigen::Vector3d& t = object.robot_from_object.translation();
  const Eigen::Quaterniond& q = object.robot_from_object.rotation();
  pose.pose.position.x = t.x();
  pose.pose.position.y = t.y();
  pose.pose.position.z = t.z();
  pose.pose.orientation.w = q.w();
  pose.pose.orientation.x = q.x();
  pose.pose.orientation.y = q.y();
  pose.pose.orientation.z = q.z();
  return pose;
}

}  // namespace

struct RosBagWriter::Impl {
  std::filesystem::path target;
  std::filesystem::path part;
  rosbag::Bag bag;
  bool open = false;

  ~Impl() {
    if (!open) return;
    try {
      bag.close();
    } catch (const std::exception&) {  // it is thrown away
    }
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
  }

  /// The library's exceptions end here.
  template <class Body>
  Status Guard(const Body& body) {
    try {
      return body();
    } catch (const rosbag::BagException& failure) {
      return Fail(ErrorCode::kIo, "{}: {}", target.string(), failure.what());
    }
  }

  void WriteStatic(const Scan& scan, const ros::Time& time) {
    tf2_msgs::TFMessage fixed;
    fixed.transforms = {TransformOf("robot", "base", scan.rig.robot_from_base, time),
                        TransformOf("head", "camera", scan.rig.camera_from_head.Inverse(), time),
                        TransformOf("head", "lidar", scan.rig.HeadFromLidar(), time)};
    bag.write("/tf_static", time, fixed);
  }

  void WriteTurn(const Scan& scan, double time_s, double motor_rad) {
    tf2_msgs::TFMessage turn;
    const ros::Time time = TimeOf(scan, time_s);
    turn.transforms = {TransformOf("base", "head", scan.rig.BaseFromHead(motor_rad), time)};
    bag.write("/tf", time, turn);
  }
};

RosBagWriter::RosBagWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RosBagWriter::RosBagWriter(RosBagWriter&&) noexcept = default;
RosBagWriter::~RosBagWriter() = default;

Result<RosBagWriter> RosBagWriter::Create(const std::filesystem::path& path) {
  auto impl = std::make_unique<Impl>();
  FORESIGHT_TRY(impl->target, ResolveOutput(path));
  impl->part = impl->target.string() + ".part";
  FORESIGHT_CHECK(impl->Guard([&]() -> Status {
    impl->bag.open(impl->part.string(), rosbag::bagmode::Write);
    impl->open = true;
    return {};
  }));
  return RosBagWriter(std::move(impl));
}

Status RosBagWriter::Add(const BagScan& entry, const RunContext& context) {
  const Scan& scan = entry.scan;
  FORESIGHT_TRY(sensor_msgs::CameraInfo info, CameraInfoOf(scan.rig.camera));
  return impl_->Guard([&]() -> Status {
    const ros::Time begin = TimeOf(BeginUtc_ns(scan));
    impl_->WriteStatic(scan, begin);
    constexpr std::size_t kEvery = 10;
    const auto samples = scan.track.samples();
    for (std::size_t i = 0; i < samples.size(); i += kEvery)
      impl_->WriteTurn(scan, samples[i].time_s, samples[i].angle_rad);
    for (const CameraFrame& frame : scan.frames) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the export was cancelled");
      const ros::Time time = TimeOf(scan, frame.time_s);
      impl_->WriteTurn(scan, frame.time_s, frame.motor_angle_rad);
      impl_->bag.write("/foresight/camera/image", time, ImageOf(frame, time));
      info.header.stamp = time;
      impl_->bag.write("/foresight/camera/camera_info", time, info);
    }
    impl_->bag.write("/foresight/cloud", begin, CloudOf(entry.points, begin));
    for (const BagObject& object : entry.objects)
      impl_->bag.write("/foresight/objects/" + object.kind, TimeOf(object.utc_ns), PoseOf(object));
    return {};
  });
}

Status RosBagWriter::Finish() {
  FORESIGHT_CHECK(impl_->Guard([&]() -> Status {
    impl_->bag.close();
    return {};
  }));
  impl_->open = false;
  FORESIGHT_CHECK(SyncFile(impl_->part));
  std::error_code error;
  std::filesystem::rename(impl_->part, impl_->target, error);
  if (error)
    return Fail(ErrorCode::kIo, "{}: cannot replace: {}", impl_->target.string(), error.message());
  return SyncFolderOf(impl_->target);
}

}  // namespace foresight
