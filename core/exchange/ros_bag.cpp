#include "core/exchange/ros_bag.h"

#include <cstring>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/publish_file.h"
#include "core/calibration/camera_formats.h"
#include "core/exchange/bag_file.h"

namespace foresight {
namespace {

BagTime_ns TimeOf(const Scan& scan, double time_s) {
  return scan.start_utc_ns + static_cast<std::int64_t>(1e9 * time_s);
}

template <class To, class From>
BagPose PoseOf(const char* frame, const char* child, const Rigid<To, From>& frame_from_child) {
  const Eigen::Vector3d& t = frame_from_child.translation();
  const Eigen::Quaterniond& q = frame_from_child.rotation();
  return {frame, child, {t.x(), t.y(), t.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

BagCloud CloudOf(std::span<const CloudPoint> points) {
  using Type = BagField::Type;
  BagCloud cloud;
  cloud.frame = "robot";
  cloud.fields = {
      {"x", Type::kFloat32},         {"y", Type::kFloat32},   {"z", Type::kFloat32},
      {"intensity", Type::kFloat32}, {"line", Type::kInt32},  {"beam", Type::kInt32},
      {"time", Type::kFloat64},      {"rgb", Type::kFloat32}, {"confidence", Type::kFloat32}};
  constexpr std::size_t kPointBytes = 40;
  cloud.points = static_cast<std::uint32_t>(points.size());
  cloud.data.resize(kPointBytes * points.size());
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

BagImage ImageOf(const CameraFrame& frame) {
  BagImage image;
  image.frame = "camera";
  image.width = static_cast<std::uint32_t>(frame.image.width());
  image.height = static_cast<std::uint32_t>(frame.image.height());
  image.data.resize(frame.image.size() * sizeof(Rgb8));
  if (!image.data.empty()) std::memcpy(image.data.data(), frame.image.data(), image.data.size());
  return image;
}

/// In ROS's words; a model that ROS has no name for is refitted.
Result<BagCamera> CameraOf(const CameraModel& camera) {
  FORESIGHT_TRY(const CameraExport as_ros, ExportCamera(camera, CameraFormat::kRos));
  const CameraModel& c = as_ros.refit ? as_ros.refit->camera : camera;
  BagCamera info;
  info.frame = "camera";
  info.width = static_cast<std::uint32_t>(c.width);
  info.height = static_cast<std::uint32_t>(c.height);
  info.distortion_model = as_ros.model;
  info.distortion.assign(5, 0.0);
  const auto take = [&info](const auto& coefficients) {
    info.distortion.assign(coefficients.begin(), coefficients.end());
  };
  if (const auto* kb4 = std::get_if<KannalaBrandtLens>(&c.lens)) take(kb4->Parameters());
  if (const auto* radtan = std::get_if<RadialTangentialLens>(&c.lens)) take(radtan->Parameters());
  info.fx = c.fx;
  info.fy = c.fy;
  info.cx = c.cx;
  info.cy = c.cy;
  return info;
}

}  // namespace

struct RosBagWriter::Impl {
  std::filesystem::path target;
  std::filesystem::path part;
  BagFile bag;
  bool finished = false;

  ~Impl() {
    if (finished) return;
    (void)bag.Close();
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
  }

  Status Done(const std::string& failure) const {
    if (failure.empty()) return {};
    return Fail(ErrorCode::kIo, "{}: {}", target.string(), failure);
  }

  Status WriteFixed(const Scan& scan, BagTime_ns time) {
    return Done(bag.WriteTransforms("/tf_static", time,
                                    {PoseOf("robot", "base", scan.rig.robot_from_base),
                                     PoseOf("head", "camera", scan.rig.camera_from_head.Inverse()),
                                     PoseOf("head", "lidar", scan.rig.HeadFromLidar())}));
  }

  Status WriteTurn(const Scan& scan, double time_s, double motor_rad) {
    return Done(bag.WriteTransforms("/tf", TimeOf(scan, time_s),
                                    {PoseOf("base", "head", scan.rig.BaseFromHead(motor_rad))}));
  }

  Status WriteImages(const Scan& scan, const RunContext& context) {
    FORESIGHT_TRY(const BagCamera camera, CameraOf(scan.rig.camera));
    for (const CameraFrame& frame : scan.frames) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the export was cancelled");
      const BagTime_ns time = TimeOf(scan, frame.time_s);
      FORESIGHT_CHECK(WriteTurn(scan, frame.time_s, frame.motor_angle_rad));
      FORESIGHT_CHECK(Done(bag.WriteImage("/foresight/camera/image", time, ImageOf(frame))));
      FORESIGHT_CHECK(Done(bag.WriteCamera("/foresight/camera/camera_info", time, camera)));
    }
    return {};
  }
};

RosBagWriter::RosBagWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RosBagWriter::RosBagWriter(RosBagWriter&&) noexcept = default;
RosBagWriter::~RosBagWriter() = default;

Result<RosBagWriter> RosBagWriter::Create(const std::filesystem::path& path) {
  auto impl = std::make_unique<Impl>();
  FORESIGHT_TRY(impl->target, ResolveOutput(path));
  impl->part = impl->target.string() + ".part";
  FORESIGHT_CHECK(impl->Done(impl->bag.Open(impl->part.string())));
  return RosBagWriter(std::move(impl));
}

Status RosBagWriter::Add(const BagScan& entry, const RunContext& context) {
  const Scan& scan = entry.scan;
  const BagTime_ns begin = BeginUtc_ns(scan);
  FORESIGHT_CHECK(impl_->WriteFixed(scan, begin));
  constexpr std::size_t kEvery = 10;
  const auto samples = scan.track.samples();
  for (std::size_t i = 0; i < samples.size(); i += kEvery)
    FORESIGHT_CHECK(impl_->WriteTurn(scan, samples[i].time_s, samples[i].angle_rad));
  FORESIGHT_CHECK(impl_->WriteImages(scan, context));
  FORESIGHT_CHECK(impl_->Done(impl_->bag.WriteText("/foresight/scan", begin, entry.record)));
  FORESIGHT_CHECK(
      impl_->Done(impl_->bag.WriteCloud("/foresight/cloud", begin, CloudOf(entry.points))));
  for (const BagObject& object : entry.objects)
    FORESIGHT_CHECK(impl_->Done(
        impl_->bag.WritePose("/foresight/objects/" + object.kind, object.utc_ns,
                             PoseOf("robot", object.kind.c_str(), object.robot_from_object))));
  return {};
}

Status RosBagWriter::Finish() {
  FORESIGHT_CHECK(impl_->Done(impl_->bag.Close()));
  impl_->finished = true;
  return PublishFile(impl_->part, impl_->target);
}

}  // namespace foresight
