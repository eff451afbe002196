#include "core/exchange/import_bag.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/printable.h"
#include "core/calibration/camera_formats.h"
#include "core/exchange/bag_file.h"
#include "core/io/cloud_columns.h"
#include "core/io/jpeg.h"
#include "core/io/png.h"
#include "core/io/read_point_cloud.h"

namespace foresight {
namespace {

using Pose = Rigid<frame::Robot, frame::Robot>;  // frames of a bag have names of their own

constexpr const char* kCloudType = "sensor_msgs/PointCloud2";
constexpr const char* kPoseType = "geometry_msgs/PoseStamped";
/// A topic of a robot's way has thousands.
constexpr std::size_t kMostPosesOfATopic = 100;
constexpr const char* kRecordTopic = "/foresight/scan";

bool IsImageType(const std::string& type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage";
}

/// What tf says: where each frame lies in its parent, over time.
class TransformTree {
 public:
  Status Add(const std::pair<BagTime_ns, BagPose>& stamped, const std::string& source) {
    const BagPose& pose = stamped.second;
    const Eigen::Quaterniond rotation(pose.rotation_wxyz[0], pose.rotation_wxyz[1],
                                      pose.rotation_wxyz[2], pose.rotation_wxyz[3]);
    const Eigen::Vector3d translation(pose.position_m.data());
    constexpr double kUnit = 1e-2;
    if (!translation.allFinite() || !(std::abs(rotation.norm() - 1.0) < kUnit))
      return Fail(ErrorCode::kBadData, "{}: the transform from {} to {} is none", source,
                  Printable(pose.child), Printable(pose.frame));
    Link& link = links_[pose.child];
    link.parent = pose.frame;
    link.poses.emplace_back(stamped.first, Pose(rotation, translation));
    return {};
  }

  bool Has(const std::string& frame) const {
    return links_.contains(frame) ||
           std::any_of(links_.begin(), links_.end(),
                       [&](const auto& link) { return link.second.parent == frame; });
  }

  /// Takes coordinates in `from` to those in `to`; nullopt where tf does not join them.
  std::optional<Pose> Find(const std::string& to, const std::string& from, BagTime_ns time) const {
    if (to == from) return Pose();
    const auto up_from = ToAncestors(from, time), up_to = ToAncestors(to, time);
    for (const auto& [name, ancestor_from] : up_from)
      for (const auto& [other, ancestor_to] : up_to)
        if (name == other) return ancestor_to.Inverse() * ancestor_from;
    return std::nullopt;
  }

 private:
  struct Link {
    std::string parent;
    std::vector<std::pair<BagTime_ns, Pose>> poses;
  };

  std::vector<std::pair<std::string, Pose>> ToAncestors(std::string frame, BagTime_ns time) const {
    std::vector<std::pair<std::string, Pose>> chain = {{frame, Pose()}};
    std::set<std::string> seen = {frame};
    for (auto link = links_.find(frame); link != links_.end(); link = links_.find(frame)) {
      const auto nearest = std::min_element(
          link->second.poses.begin(), link->second.poses.end(), [&](const auto& a, const auto& b) {
            return std::abs(a.first - time) < std::abs(b.first - time);
          });
      frame = link->second.parent;
      if (!seen.insert(frame).second) break;  // a circle
      chain.emplace_back(frame, nearest->second * chain.back().second);
    }
    return chain;
  }

  std::map<std::string, Link> links_;
};

std::optional<CloudScalar> ScalarOf(std::uint8_t type) {
  using enum CloudScalar;
  constexpr std::array kTypes = {kInt8,  kUint8,  kInt16,   kUint16,
                                 kInt32, kUint32, kFloat32, kFloat64};
  if (type < 1 || type > kTypes.size()) return std::nullopt;
  return kTypes[type - 1U];
}

/// In metres; the message's coordinates are in `unit_m`.
Result<CloudTable> TableFrom(const BagCloudMessage& message, double unit_m,
                             const std::string& source) {
  const std::size_t count = std::size_t{message.width} * message.height;
  const std::size_t row = std::size_t{message.width} * message.point_step;
  const std::size_t row_step = message.height > 1 ? message.row_step : row;
  constexpr std::size_t kMostPointBytes = 1 << 16;
  if (count > kMostCloudPoints || message.point_step > kMostPointBytes || row_step < row ||
      row_step * message.height > message.data.size())
    return Fail(ErrorCode::kBadData, "{}: {} x {} points of {} bytes do not fit into {} bytes",
                source, message.width, message.height, message.point_step, message.data.size());
  std::string block;
  for (std::size_t i = 0; i < message.height; ++i)
    block.append(reinterpret_cast<const char*>(message.data.data()) + i * row_step, row);
  std::vector<NamedColumn> columns;
  for (const BagCloudMessage::Field& field : message.fields) {
    auto type = ScalarOf(field.type);
    if (!IsCloudColumn(field.name) || !type || field.count > 1) continue;
    if (field.offset + SizeOf(*type) > message.point_step)
      return Fail(ErrorCode::kBadData, "{}: its field '{}' lies outside of a point", source,
                  Printable(field.name));
    NamedColumn column{
        field.name, *type == CloudScalar::kFloat32 || *type == CloudScalar::kFloat64, false, {}};
    if (field.name.starts_with("rgb") && SizeOf(*type) == 4) {
      column.has_color_bits = true;
      type = CloudScalar::kUint32;
    }
    column.values = ValuesFromColumn(block, {*type, field.offset, message.point_step}, count,
                                     message.big_endian);
    columns.push_back(std::move(column));
  }
  CloudTable table;
  table.width = message.width;
  table.height = message.height;
  FORESIGHT_CHECK(TakeColumns(std::move(columns), table, source));
  ScaleToMetres(unit_m, table);
  FORESIGHT_CHECK(CheckCloudPoints(table.points, source));
  return table;
}

Result<ColorImage> PixelsFrom(const BagImageMessage& message, const std::string& source) {
  const std::string_view bytes(reinterpret_cast<const char*>(message.data.data()),
                               message.data.size());
  if (message.encoding == "png") return DecodePng(bytes, source);
  if (message.encoding == "jpeg") return DecodeJpeg(bytes, source);
  struct Encoding {
    const char* name;
    std::size_t channels;
    std::array<std::size_t, 3> rgb;
  };
  constexpr Encoding kEncodings[] = {{"rgb8", 3, {0, 1, 2}},  {"bgr8", 3, {2, 1, 0}},
                                     {"8UC3", 3, {2, 1, 0}},  {"rgba8", 4, {0, 1, 2}},
                                     {"bgra8", 4, {2, 1, 0}}, {"mono8", 1, {0, 0, 0}},
                                     {"8UC1", 1, {0, 0, 0}}};
  const auto* encoding =
      std::find_if(std::begin(kEncodings), std::end(kEncodings),
                   [&](const Encoding& known) { return message.encoding == known.name; });
  if (encoding == std::end(kEncodings))
    return Fail(ErrorCode::kBadData, "{}: the encoding '{}' is not read", source,
                Printable(message.encoding.substr(0, 32)));
  constexpr std::uint32_t kMostSide = 20000;
  const std::size_t row = std::size_t{message.width} * encoding->channels;
  if (message.width < 1 || message.height < 1 || message.width > kMostSide ||
      message.height > kMostSide || message.step < row ||
      std::size_t{message.step} * message.height > message.data.size())
    return Fail(ErrorCode::kBadData, "{}: {} x {} pixels of {} do not fit into {} bytes", source,
                message.width, message.height, message.encoding, message.data.size());
  ColorImage image(static_cast<int>(message.width), static_cast<int>(message.height));
  auto pixel = image.values().begin();
  for (std::size_t y = 0; y < message.height; ++y)
    for (std::size_t x = 0; x < message.width; ++x, ++pixel) {
      const std::uint8_t* at = message.data.data() + y * message.step + x * encoding->channels;
      *pixel = {at[encoding->rgb[0]], at[encoding->rgb[1]], at[encoding->rgb[2]]};
    }
  return image;
}

/// By way of ROS's own file, whose reader checks it.
Result<CameraModel> CameraFrom(const BagCamera& camera, const std::string& source) {
  std::string distortion;
  for (const double value : camera.distortion)
    distortion += fmt::format("{}{}", distortion.empty() ? "" : ", ", value);
  if (distortion.empty()) distortion = "0, 0, 0, 0, 0";
  const std::string model =
      camera.distortion_model.empty() ? "plumb_bob" : Printable(camera.distortion_model);
  const std::size_t coefficients = std::max<std::size_t>(camera.distortion.size(), 1);
  const std::string yaml = fmt::format(
      "image_width: {}\nimage_height: {}\ncamera_name: bag\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [{}, 0, {}, 0, {}, {}, 0, 0, 1]\ndistortion_model: {}\n"
      "distortion_coefficients:\n  rows: 1\n  cols: {}\n  data: [{}]\n",
      camera.width, camera.height, camera.fx, camera.cx, camera.fy, camera.cy, model,
      camera.distortion.empty() ? 5 : coefficients, distortion);
  return ImportCamera(yaml, CameraFormat::kRos, source);
}

std::string WithoutSlash(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

class BagImport {
 public:
  BagImport(const std::filesystem::path& path, const ImportOptions& options)
      : source_(path.string()), name_(path.filename().string()), options_(options) {}

  Status Run(const std::function<Status(ImportedScan)>& take, const RunContext& context) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(source_, error))
      return Fail(ErrorCode::kIo, "{}: is no file that can be read", source_);
    FORESIGHT_CHECK(Done(bag_.Open(source_)));
    FORESIGHT_CHECK(Done(bag_.ReadTopics(&topics_)));
    FORESIGHT_CHECK(ChooseTopics());
    FORESIGHT_CHECK(ReadTransforms());
    std::vector<std::size_t> wanted;
    for (const int number : options_.clouds) {
      if (number < 1 || static_cast<std::size_t>(number) > cloud_->times.size())
        return Fail(ErrorCode::kInvalidOptions, "{}: {} has {} clouds, there is no {}", source_,
                    cloud_->name, cloud_->times.size(), number);
      wanted.push_back(static_cast<std::size_t>(number - 1));
    }
    for (std::size_t i = 0; options_.clouds.empty() && i < cloud_->times.size(); ++i)
      wanted.push_back(i);
    FORESIGHT_CHECK(ReadPoses(wanted));
    double done = 0.0;
    for (const std::size_t number : wanted) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the import was cancelled");
      context.Report(done++ / static_cast<double>(wanted.size()), "importing clouds");
      FORESIGHT_TRY(ImportedScan scan, ImportOne(number));
      FORESIGHT_CHECK(take(std::move(scan)));
    }
    return {};
  }

 private:
  Status Done(const std::string& failure) const {
    if (failure.empty()) return {};
    return Fail(ErrorCode::kBadData, "{}: {}", source_, Printable(failure));
  }

  const BagTopic* Topic(const std::string& name) const {
    const auto found = std::find_if(topics_.begin(), topics_.end(),
                                    [&](const BagTopic& topic) { return topic.name == name; });
    return found == topics_.end() ? nullptr : &*found;
  }

  template <class Accepts>
  Result<const BagTopic*> Choose(const std::string& wanted, const char* what, const char* option,
                                 const Accepts& accepts) const {
    std::vector<const BagTopic*> fitting;
    std::string names;
    for (const BagTopic& topic : topics_) {
      if (!accepts(topic.type) || topic.times.empty()) continue;
      if (topic.name == wanted) return &topic;
      fitting.push_back(&topic);
      names += (names.empty() ? "" : ", ") + Printable(topic.name);
    }
    if (!wanted.empty())
      return Fail(ErrorCode::kInvalidOptions, "{}: {} is no topic of {}; there are: {}", source_,
                  Printable(wanted), what, names.empty() ? "none" : names);
    if (fitting.size() > 1)
      return Fail(ErrorCode::kInvalidOptions, "{}: has several topics of {}; choose one ({}): {}",
                  source_, what, option, names);
    return fitting.empty() ? nullptr : fitting.front();
  }

  Status ChooseTopics() {
    FORESIGHT_TRY(cloud_, Choose(options_.cloud_topic, "clouds", "--cloud-topic",
                                 [](const std::string& type) { return type == kCloudType; }));
    if (cloud_ == nullptr)
      return Fail(ErrorCode::kBadData, "{}: has no sensor_msgs/PointCloud2", source_);
    FORESIGHT_TRY(image_, Choose(options_.image_topic, "images", "--image-topic", IsImageType));
    if (Topic(kRecordTopic) != nullptr && Topic(kRecordTopic)->type == "std_msgs/String" &&
        Topic(kRecordTopic)->times.size() == cloud_->times.size() &&
        cloud_->name == "/foresight/cloud")
      record_ = Topic(kRecordTopic);
    return {};
  }

  Status ReadTransforms() {
    for (const BagTopic& topic : topics_) {
      if (topic.type != "tf2_msgs/TFMessage" && topic.type != "tf/tfMessage") continue;
      std::vector<std::pair<BagTime_ns, BagPose>> poses;
      FORESIGHT_CHECK(Done(bag_.ReadTransforms(topic.name, &poses)));
      for (const auto& pose : poses) FORESIGHT_CHECK(tree_.Add(pose, source_));
    }
    return {};
  }

  /// Each pose belongs to the last cloud before it, or else to the first one.
  Status ReadPoses(const std::vector<std::size_t>& wanted) {
    if (wanted.empty()) return {};
    const auto time = [&](std::size_t number) { return cloud_->times[number]; };
    const std::size_t first =
        *std::min_element(wanted.begin(), wanted.end(),
                          [&](std::size_t a, std::size_t b) { return time(a) < time(b); });
    for (const BagTopic& topic : topics_) {
      if (topic.type != kPoseType) continue;
      std::vector<std::pair<BagTime_ns, BagPose>> poses;
      FORESIGHT_CHECK(Done(bag_.ReadPoses(topic.name, kMostPosesOfATopic, &poses)));
      const std::string name = Printable(topic.name);
      if (topic.times.size() > poses.size())
        poses_[first].notes.push_back(fmt::format("of {} poses of {} the first {} are kept",
                                                  topic.times.size(), name, poses.size()));
      for (const auto& [stamp, pose] : poses) {
        std::size_t owner = first;
        for (const std::size_t number : wanted)
          if (time(number) <= stamp && time(number) > time(owner)) owner = number;
        const auto finite = [](double value) { return std::isfinite(value); };
        if (!std::all_of(pose.position_m.begin(), pose.position_m.end(), finite) ||
            !std::all_of(pose.rotation_wxyz.begin(), pose.rotation_wxyz.end(), finite)) {
          poses_[owner].notes.push_back(
              fmt::format("a pose of {} that is not finite is left out", name));
          continue;
        }
        poses_[owner].poses.push_back(
            {name, Printable(pose.frame), stamp, pose.position_m, pose.rotation_wxyz});
      }
    }
    return {};
  }

  Result<ImportedScan> ImportOne(std::size_t number) {
    BagCloudMessage message;
    FORESIGHT_CHECK(Done(bag_.ReadCloud(cloud_->name, number, &message)));
    const std::string where = fmt::format("{}: {}, cloud {}", source_, cloud_->name, number + 1);
    notes_.clear();
    ScanParts parts;
    parts.name = cloud_->times.size() == 1
                     ? name_
                     : fmt::format("{}, cloud {} of {}", name_, number + 1, cloud_->times.size());
    FORESIGHT_TRY(parts.cloud, TableFrom(message, options_.unit_m, where));
    if (record_ != nullptr) {
      FORESIGHT_CHECK(TakeOwnScan(number, parts));
    } else {
      PlaceInTime(message, parts);
      PlaceInFrames(message, parts);
      FORESIGHT_CHECK(TakeImage(message, parts));
    }
    FORESIGHT_TRY(ImportedScan scan, AssembleScan(std::move(parts), options_));
    scan.notes.insert(scan.notes.begin(), notes_.begin(), notes_.end());
    const PosesOfCloud& told = poses_[number];
    scan.notes.insert(scan.notes.end(), told.notes.begin(), told.notes.end());
    scan.poses = told.poses;
    return scan;
  }

  /// What an export of a mission has written.
  Status TakeOwnScan(std::size_t number, ScanParts& parts) {
    std::string json;
    FORESIGHT_CHECK(Done(bag_.ReadText(record_->name, number, &json)));
    FORESIGHT_TRY(parts.record,
                  ScanRecordFromJson(json, fmt::format("{}: {}", source_, kRecordTopic)));
    if (image_ == nullptr) return {};
    constexpr BagTime_ns kSame_ns = 1000;
    for (const CameraFrame& expected : parts.record->images) {
      const BagTime_ns time =
          parts.record->start_utc_ns + static_cast<BagTime_ns>(1e9 * expected.time_s);
      const std::size_t nearest = NearestImage(time);
      if (std::abs(image_->times[nearest] - time) > kSame_ns)
        return Fail(ErrorCode::kBadData, "{}: {} has no image at {:.6f} s of its scan", source_,
                    image_->name, expected.time_s);
      CameraFrame frame = expected;
      FORESIGHT_CHECK(ReadPixels(nearest, frame));
      parts.images.push_back(std::move(frame));
    }
    return {};
  }

  /// @pre there is an image
  std::size_t NearestImage(BagTime_ns time) const {
    const auto nearest = std::min_element(
        image_->times.begin(), image_->times.end(),
        [time](BagTime_ns a, BagTime_ns b) { return std::abs(a - time) < std::abs(b - time); });
    return static_cast<std::size_t>(nearest - image_->times.begin());
  }

  Result<BagImageMessage> ReadPixels(std::size_t number, CameraFrame& frame) {
    BagImageMessage message;
    FORESIGHT_CHECK(Done(bag_.ReadImage(*image_, number, &message)));
    FORESIGHT_TRY(frame.image, PixelsFrom(message, fmt::format("{}: {}, image {}", source_,
                                                               image_->name, number + 1)));
    return message;
  }

  /// The scan's clock begins so that its first point was measured at the message's stamp.
  static void PlaceInTime(const BagCloudMessage& message, ScanParts& parts) {
    constexpr double kEpoch_s = 1e8;
    double first_s = 0.0;
    for (const double time : parts.cloud.time_s)
      if (std::isfinite(time)) {
        first_s = time;
        break;
      }
    if (std::abs(first_s) > kEpoch_s) first_s = 0.0;
    parts.start_utc_ns = message.time - static_cast<std::int64_t>(1e9 * first_s);
  }

  void PlaceInFrames(const BagCloudMessage& message, ScanParts& parts) {
    const std::string cloud = WithoutSlash(message.frame);
    std::string robot;
    for (const char* name : {"robot", "base_link", "base_footprint"})
      if (robot.empty() && tree_.Has(name)) robot = name;
    if (const auto found = robot.empty() ? std::nullopt : tree_.Find(robot, cloud, message.time)) {
      parts.robot_from_cloud = found->Matrix();
      if (robot != cloud) notes_.push_back(fmt::format("its frame '{}' is the robot's", robot));
    }
    for (const char* name : {"lidar", "velodyne", "laser", "os_sensor", "os_lidar", "lidar_link"}) {
      if (parts.viewpoint || name == cloud || cloud != robot) continue;
      if (const auto found =
              tree_.Has(name) ? tree_.Find(cloud, name, message.time) : std::nullopt) {
        parts.viewpoint = found->translation();
        notes_.push_back(fmt::format("its points were measured from where '{}' stood", name));
      }
    }
  }

  Status TakeImage(const BagCloudMessage& cloud, ScanParts& parts) {
    if (image_ == nullptr) return {};
    const std::size_t number = NearestImage(cloud.time);
    CameraFrame frame;
    FORESIGHT_TRY(const BagImageMessage message, ReadPixels(number, frame));
    frame.time_s = 1e-9 * static_cast<double>(message.time - *parts.start_utc_ns);
    if (options_.rig) {
      parts.images.push_back(std::move(frame));
      return {};
    }
    const auto leave_out = [&](const std::string& why) {
      notes_.push_back(fmt::format("its image is left out: {} (--rig gives a camera)", why));
    };
    const BagTopic* info = InfoOfImages();
    if (info == nullptr) {
      leave_out("no sensor_msgs/CameraInfo belongs to it");
      return {};
    }
    BagCamera camera;
    FORESIGHT_CHECK(Done(bag_.ReadCamera(info->name, image_->times[number], &camera)));
    auto model = CameraFrom(camera, fmt::format("{}: {}", source_, info->name));
    if (!model) {
      leave_out(model.error().message);
      return {};
    }
    const std::string frame_name =
        WithoutSlash(message.frame.empty() ? camera.frame : message.frame);
    const auto camera_from_cloud = tree_.Find(frame_name, WithoutSlash(cloud.frame), message.time);
    if (!camera_from_cloud) {
      leave_out(fmt::format("tf does not say how '{}' lies to '{}'", Printable(frame_name),
                            Printable(cloud.frame)));
      return {};
    }
    const double apart_s = 1e-9 * static_cast<double>(std::abs(message.time - cloud.time));
    if (apart_s > 0.05)
      notes_.push_back(fmt::format("its image was taken {:.2f} s from the cloud", apart_s));
    parts.camera =
        CameraOnCloud{*model, {camera_from_cloud->rotation(), camera_from_cloud->translation()}};
    parts.images.push_back(std::move(frame));
    return {};
  }

  /// The CameraInfo beside an image's topic, or the only one.
  const BagTopic* InfoOfImages() const {
    const std::string base = image_->name.substr(0, image_->name.rfind('/'));
    const std::string outer = base.substr(0, base.rfind('/'));
    const BagTopic* only = nullptr;
    int count = 0;
    for (const BagTopic& topic : topics_) {
      if (topic.type != "sensor_msgs/CameraInfo" || topic.times.empty()) continue;
      if (topic.name == base + "/camera_info" || topic.name == outer + "/camera_info")
        return &topic;
      only = &topic;
      ++count;
    }
    return count == 1 ? only : nullptr;
  }

  struct PosesOfCloud {
    std::vector<ImportedPose> poses;
    std::vector<std::string> notes;
  };

  const std::string source_;
  const std::string name_;
  const ImportOptions& options_;
  BagReader bag_;
  std::vector<BagTopic> topics_;
  const BagTopic* cloud_ = nullptr;
  const BagTopic* image_ = nullptr;
  const BagTopic* record_ = nullptr;
  TransformTree tree_;
  std::map<std::size_t, PosesOfCloud> poses_;  ///< by the number of their cloud
  std::vector<std::string> notes_;
};

}  // namespace

Status ImportBag(const std::filesystem::path& path, const ImportOptions& options,
                 const std::function<Status(ImportedScan)>& take, const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  return BagImport(path, options).Run(take, context);
}

}  // namespace foresight
