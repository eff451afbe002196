#include "core/exchange/assemble_scan.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "core/calibration/camera_of_grid.h"
#include "core/geometry/angles.h"
#include "core/geometry/nearest_rotation.h"
#include "core/registration/recover_grid.h"

namespace foresight {
namespace {

using RobotFromCloud = Rigid<frame::Robot, frame::Robot>;  // "cloud" has no name of its own

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// How base lies on a robot whose z is up: x right, y down, z ahead; its origin at `place`.
Rigid<frame::Robot, frame::Base> BaseAt(const Eigen::Vector3d& place) {
  Eigen::Matrix3d axes;  // of base, as columns
  axes.col(0) = -Eigen::Vector3d::UnitY();
  axes.col(1) = -Eigen::Vector3d::UnitZ();
  axes.col(2) = Eigen::Vector3d::UnitX();
  return {axes, place};
}

/// Turns `up` to z, and what is ahead (x or, where that is up, y) as far as it can to x.
Eigen::Matrix3d UpToZ(const Eigen::Vector3d& given) {
  const Eigen::Vector3d up = given.normalized();
  if (up == Eigen::Vector3d::UnitZ()) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d ahead =
      std::abs(up.x()) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  Eigen::Matrix3d rows;
  rows.row(0) = (ahead - ahead.dot(up) * up).normalized().transpose();
  rows.row(2) = up.transpose();
  rows.row(1) = rows.row(2).cross(rows.row(0));
  return rows;
}

class Assembler {
 public:
  Assembler(ScanParts parts, const ImportOptions& options)
      : parts_(std::move(parts)), options_(options) {}

  Result<ImportedScan> Run() {
    FORESIGHT_CHECK(options_.Check());
    FORESIGHT_CHECK(ChooseViewpoint());
    FORESIGHT_CHECK(FindGrid());
    FORESIGHT_CHECK(FindCamera());
    FORESIGHT_CHECK(MakeRig());
    FORESIGHT_CHECK(PlacePoints());
    FORESIGHT_CHECK(TakeImages());
    Finish();
    return std::move(out_);
  }

 private:
  template <class... T>
  void Note(fmt::format_string<T...> format, T&&... values) {
    out_.notes.push_back(fmt::format(format, std::forward<T>(values)...));
  }

  bool IsOurs() const { return parts_.record.has_value(); }
  const SensorRig* KnownRig() const {
    if (options_.rig) return &*options_.rig;
    return parts_.record ? &parts_.record->rig : nullptr;
  }
  /// The points' frame where the rig is known.
  CloudFrame Frame() const { return options_.frame.value_or(CloudFrame::kRobot); }

  Status ChooseViewpoint() {
    if (options_.viewpoint) {
      viewpoint_ = *options_.viewpoint;
    } else if (parts_.viewpoint) {
      viewpoint_ = *parts_.viewpoint;
    } else if (parts_.cloud.viewpoint && !parts_.cloud.viewpoint->isZero()) {
      viewpoint_ = *parts_.cloud.viewpoint;
    } else if (KnownRig() != nullptr) {
      viewpoint_ = CloudFromBase() *
                   (KnownRig()->BaseFromHead(0.0) * KnownRig()->HeadFromLidar().translation());
      if (!IsOurs())
        Note(
            "where the points were measured from is not in the file: the rig's lidar at 0 deg is "
            "taken");
    } else {
      Note(
          "where the points were measured from is not in the file: the origin of its frame is "
          "taken (--viewpoint says otherwise)");
    }
    return {};
  }

  /// @pre KnownRig()
  Rigid<frame::Robot, frame::Base> CloudFromBase() const {
    const SensorRig& rig = *KnownRig();
    const auto as_cloud = [](const auto& rigid) {
      return Rigid<frame::Robot, frame::Base>(rigid.rotation(), rigid.translation());
    };
    switch (Frame()) {
      case CloudFrame::kRobot:
        return rig.robot_from_base;
      case CloudFrame::kBase:
        return {};
      case CloudFrame::kLidar:
        return as_cloud(rig.HeadFromLidar().Inverse() * rig.BaseFromHead(0.0).Inverse());
      case CloudFrame::kCamera:
        return as_cloud(rig.CameraFromBase(0.0));
    }
    return {};
  }

  Status FindGrid() {
    const CloudTable& cloud = parts_.cloud;
    FORESIGHT_TRY(places_,
                  GridOfTable(cloud, cloud.points, viewpoint_).map_error([this](Error error) {
                    error.message = parts_.name + ": " + error.message;
                    return error;
                  }));
    if (places_.lines == 0)
      return Fail(ErrorCode::kBadData, "{}: no point has a direction from the viewpoint",
                  parts_.name);
    switch (places_.kind) {
      case GridPlaces::Kind::kNumbers:
        if (parts_.record) {
          places_.lines = std::max(places_.lines, parts_.record->lines);
          places_.beams = std::max(places_.beams, parts_.record->beams);
        }
        out_.grid = "by the line and beam of each point";
        break;
      case GridPlaces::Kind::kRows:
        organised_ = true;
        out_.grid = fmt::format("the file's own, {} rows of {}", cloud.height, cloud.width);
        break;
      case GridPlaces::Kind::kRings:
        out_.grid = "recovered: turns of a spinning lidar";
        NoteRecoveredGrid("turns");
        break;
      case GridPlaces::Kind::kSweeps:
        out_.grid = "recovered: lines of a scanner";
        NoteRecoveredGrid("lines");
        break;
      case GridPlaces::Kind::kScattered:
        out_.grid = "none: the points have no order";
        Note(
            "no order of lines was found in the points: Eq. (7), which compares neighbours on a "
            "line, and Fig. 4, which compares neighbouring cells, find nothing to compare, and "
            "there is no surface to export");
        break;
    }
    return {};
  }

  void NoteRecoveredGrid(const char* lines) {
    Note(
        "the grid was recovered from the order and the directions of the points: {} {}, beams "
        "every {:.3f} deg",
        places_.lines, lines, DegreesFromRadians(places_.step_rad));
  }

  /// A camera that the organised cloud itself is an image of.
  Status FindCamera() {
    if (parts_.camera || KnownRig() != nullptr) return {};
    if (organised_ && parts_.images.empty() && !options_.view) {
      const auto found = CameraOfGrid(parts_.cloud.points, static_cast<int>(parts_.cloud.width));
      if (found) {
        parts_.camera = CameraOnCloud{found->camera, found->camera_from_cloud};
        Note(
            "the cloud is an image of a depth camera: its pinhole of {:.0f} x {:.0f} px focal "
            "length was found from the points' pixels, {:.2f} px rms; {:.1f} % of the points "
            "appear elsewhere",
            found->camera.fx, found->camera.fy, found->rms_px,
            100.0 * (1.0 - found->agreeing_ratio));
        TakeOwnColors();
        return {};
      }
    }
    if (!parts_.images.empty())
      return Fail(ErrorCode::kInvalidInput,
                  "{}: an image needs its camera: give a rig, or a calibration of KITTI's form",
                  parts_.name);
    return {};
  }

  /// The colours of an organised cloud are the image that it belongs to.
  void TakeOwnColors() {
    const CloudTable& cloud = parts_.cloud;
    if (cloud.color.size() != cloud.points.size()) {
      Note("the cloud has no colours, so there is no image");
      return;
    }
    CameraFrame frame;
    frame.image = ColorImage(static_cast<int>(cloud.width), static_cast<int>(cloud.height));
    std::copy(cloud.color.begin(), cloud.color.end(), frame.image.values().begin());
    parts_.images.push_back(std::move(frame));
    Note(
        "its image is made of the points' own colours; pixels without a point are as the file has "
        "them");
  }

  Status MakeRig() {
    SensorRig& rig = out_.scan.rig;
    if (KnownRig() != nullptr) {
      rig = *KnownRig();
      const auto base_from_cloud = CloudFromBase().Inverse();
      base_from_cloud_ = {base_from_cloud.rotation(), base_from_cloud.translation()};
      if (!IsOurs() && !options_.frame)
        Note("the points are taken to be in the rig's robot frame (--frame says otherwise)");
      return rig.Check();
    }
    RobotFromCloud robot_from_cloud(UpToZ(options_.up), Eigen::Vector3d::Zero());
    if (parts_.robot_from_cloud)
      robot_from_cloud = {NearestRotation(parts_.robot_from_cloud->topLeftCorner<3, 3>()),
                          parts_.robot_from_cloud->topRightCorner<3, 1>()};
    else
      Note("the robot's frame is taken to be the cloud's, with ({:.3g}, {:.3g}, {:.3g}) up{}",
           options_.up.x(), options_.up.y(), options_.up.z(),
           options_.up == Eigen::Vector3d::UnitZ() ? " (--up says otherwise)" : "");
    rig.name = "imported";
    rig.robot_from_base = BaseAt(robot_from_cloud * viewpoint_);
    const Rigid<frame::Base, frame::Robot> base_from_cloud =
        rig.robot_from_base.Inverse() * robot_from_cloud;
    base_from_cloud_ = {base_from_cloud.rotation(), base_from_cloud.translation()};
    // The lidar's axes as the robot's: base at the viewpoint, x of the lidar ahead.
    const Rigid<frame::Head, frame::Lidar> head_from_lidar(
        rig.robot_from_base.rotation().conjugate(), Eigen::Vector3d::Zero());
    FORESIGHT_CHECK(SetCamera(rig, base_from_cloud));
    rig.camera_from_lidar = rig.camera_from_head * head_from_lidar;
    rig.lidar = LidarModel();
    rig.lidar.beams = places_.beams;
    rig.lidar.first_angle_rad = 0.0;
    const double most_step = 2.0 * std::numbers::pi / places_.beams;
    const double step = places_.step_rad > 0.0 ? places_.step_rad : LidarModel().angle_step_rad;
    rig.lidar.angle_step_rad = std::min(step, most_step);
    rig.lidar.min_range_m = 0.0;
    rig.lidar.max_range_m = 65.0;  // as far as a rig can say; the cloud may reach further
    return rig.Check();
  }

  Status SetCamera(SensorRig& rig, const Rigid<frame::Base, frame::Robot>& base_from_cloud) {
    if (parts_.camera && !(options_.view && parts_.images.empty())) {
      rig.camera = parts_.camera->camera;
      if (rig.camera.width == 0 && !parts_.images.empty()) {
        rig.camera.width = parts_.images.front().image.width();
        rig.camera.height = parts_.images.front().image.height();
      }
      if (rig.camera.width == 0) {
        Note("there is no image, so the size of the camera's is taken from its middle");
        rig.camera.width = std::max(2, static_cast<int>(std::lround(2.0 * rig.camera.cx)));
        rig.camera.height = std::max(2, static_cast<int>(std::lround(2.0 * rig.camera.cy)));
      }
      const auto camera_from_base = parts_.camera->camera_from_cloud * base_from_cloud.Inverse();
      rig.camera_from_head = {camera_from_base.rotation(), camera_from_base.translation()};
      return rig.camera.Check();
    }
    const BlankView view = options_.view.value_or(BlankView());
    FORESIGHT_CHECK(view.Check());
    const double focal_px = 0.5 * view.width / std::tan(0.5 * view.field_rad);
    rig.camera = PinholeCamera(view.width, view.height, focal_px, 0.5 * (view.width - 1),
                               0.5 * (view.height - 1));
    // Camera and base agree in their axes where the view is ahead.
    const Eigen::Quaterniond base_from_camera =
        Eigen::Quaterniond(Eigen::AngleAxisd(-view.azimuth_rad, Eigen::Vector3d::UnitY())) *
        Eigen::Quaterniond(Eigen::AngleAxisd(view.elevation_rad, Eigen::Vector3d::UnitX()));
    rig.camera_from_head =
        Rigid<frame::Camera, frame::Head>(base_from_camera.conjugate(), Eigen::Vector3d::Zero());
    if (options_.view) {
      AddGreyImage(rig.camera);
    } else if (parts_.images.empty()) {
      Note("there is no image: depth maps need one, or a view (--view) of the points alone");
    }
    return {};
  }

  void AddGreyImage(const CameraModel& camera) {
    CameraFrame frame;
    frame.image = ColorImage(camera.width, camera.height, {128, 128, 128});
    parts_.images.push_back(std::move(frame));
    Note("its image is grey: nothing was taken there, a depth map is made of the points alone");
  }

  Status PlacePoints() {
    GivenCloud& given = out_.scan.given;
    const CloudTable& cloud = parts_.cloud;
    given.lines = places_.lines;
    given.beams = places_.beams;
    const double cells = static_cast<double>(given.lines) * given.beams;
    if (cells > static_cast<double>(GivenCloud::kMostCells))
      return Fail(ErrorCode::kBadData, "{}: a grid of {} lines of {} beams is too large",
                  parts_.name, given.lines, given.beams);
    const auto places = static_cast<std::size_t>(cells);
    const auto points = given.points.Append(places, Eigen::Vector3f::Constant(kNaN));
    std::span<float> intensity;
    std::span<double> time_s;
    if (cloud.intensity.size() == cloud.points.size())
      intensity = given.intensity.Append(places, 0.0f);
    if (HasTimes()) time_s = given.time_s.Append(places, std::numeric_limits<double>::quiet_NaN());
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      if (places_.line[i] < 0) {
        ++left_out;
        continue;
      }
      const std::size_t at = given.Index(places_.line[i], places_.beam[i]);
      points[at] = (base_from_cloud_ * cloud.points[i]).cast<float>();
      if (!intensity.empty()) intensity[at] = cloud.intensity[i];
      if (!time_s.empty()) time_s[at] = cloud.time_s[i] - time_zero_s_;
      ++out_.points;
    }
    if (left_out > 0)
      Note("{} of {} points are left out: they are not finite, or at the viewpoint", left_out,
           cloud.points.size());
    PlaceOrigins(given);
    return given.Check();
  }

  void PlaceOrigins(GivenCloud& given) {
    const Eigen::Vector3f viewpoint = (base_from_cloud_ * viewpoint_).cast<float>();
    const auto origins = given.origins.Append(static_cast<std::size_t>(given.lines), viewpoint);
    // A rig of one's own may stand elsewhere: the record's origins are in its base.
    if (!parts_.record || options_.rig) return;
    for (std::size_t line = 0; line < std::min(origins.size(), parts_.record->origins.size());
         ++line)
      origins[line] = parts_.record->origins[line];
  }

  bool HasTimes() {
    const CloudTable& cloud = parts_.cloud;
    if (cloud.time_s.size() != cloud.points.size() || cloud.points.empty()) return false;
    const auto first = std::find_if(cloud.time_s.begin(), cloud.time_s.end(),
                                    [](double time) { return std::isfinite(time); });
    if (first == cloud.time_s.end()) return false;
    // Seconds since 1970 do not belong on a scan's clock.
    constexpr double kEpoch_s = 1e8;
    if (!parts_.record && std::abs(*first) > kEpoch_s) {
      time_zero_s_ = *first;
      if (*first > 0.0 && *first < 9e9 && !parts_.start_utc_ns)
        parts_.start_utc_ns = static_cast<std::int64_t>(1e9 * *first);
    }
    return true;
  }

  Status TakeImages() {
    const CameraModel& camera = out_.scan.rig.camera;
    std::vector<CameraFrame>& images = parts_.images;
    if (KnownRig() != nullptr && images.empty() && options_.view) AddGreyImage(camera);
    const std::vector<double>& angles = options_.image_angles_rad;
    if (!angles.empty() && angles.size() != images.size())
      return Fail(ErrorCode::kInvalidOptions, "{} angles for {} images", angles.size(),
                  images.size());
    if (parts_.record && parts_.record->images.size() == images.size()) {
      for (std::size_t i = 0; i < images.size(); ++i) {
        ColorImage pixels = std::move(images[i].image);
        images[i] = parts_.record->images[i];
        images[i].image = std::move(pixels);
      }
    } else if (KnownRig() != nullptr && !images.empty() && angles.empty()) {
      Note(
          "the motor's angle of the image is not in the files: 0 deg is taken (--image-deg says "
          "otherwise)");
    }
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (!angles.empty()) images[i].motor_angle_rad = images[i].target_angle_rad = angles[i];
      if (images[i].image.width() != camera.width || images[i].image.height() != camera.height)
        return Fail(ErrorCode::kInvalidInput, "{}: image {} is {} x {}, but its camera {} x {}",
                    parts_.name, i, images[i].image.width(), images[i].image.height(), camera.width,
                    camera.height);
      out_.scan.frames.push_back(std::move(images[i]));
    }
    return {};
  }

  void Finish() {
    Scan& scan = out_.scan;
    scan.uuid = NewUuid();
    scan.source = "imported: " + parts_.name;
    scan.state = ScanState::kComplete;
    scan.start_utc_ns = parts_.start_utc_ns.value_or(0);
    if (parts_.record) {
      out_.of_scan_uuid = parts_.record->scan_uuid;
      scan.start_utc_ns = parts_.record->start_utc_ns;
      scan.simulated = parts_.record->simulated;
    }
    // Nobody swept; the plan names the images, and is one that can be.
    ScanPlan& plan = scan.plan;
    plan.image_angles_rad.clear();
    for (const CameraFrame& frame : scan.frames) {
      const double angle = std::isfinite(frame.target_angle_rad) ? frame.target_angle_rad : 0.0;
      plan.image_angles_rad.push_back(
          std::clamp(angle, ScanPlan::kMinAngle_rad, ScanPlan::kMaxAngle_rad));
    }
    if (plan.image_angles_rad.empty()) plan.image_angles_rad.push_back(0.0);
    for (const double angle : plan.image_angles_rad) {
      plan.from_rad = std::min(plan.from_rad, angle);
      plan.to_rad = std::max(plan.to_rad, angle);
    }
  }

  ScanParts parts_;
  const ImportOptions& options_;
  Eigen::Vector3d viewpoint_ = Eigen::Vector3d::Zero();
  GridPlaces places_;
  bool organised_ = false;
  Rigid<frame::Base, frame::Robot> base_from_cloud_;
  double time_zero_s_ = 0.0;
  ImportedScan out_;
};

}  // namespace

Result<CloudFrame> CloudFrameFromText(std::string_view text) {
  constexpr std::pair<std::string_view, CloudFrame> kFrames[] = {{"robot", CloudFrame::kRobot},
                                                                 {"base", CloudFrame::kBase},
                                                                 {"lidar", CloudFrame::kLidar},
                                                                 {"camera", CloudFrame::kCamera}};
  for (const auto& [name, frame] : kFrames)
    if (name == text) return frame;
  return Fail(ErrorCode::kInvalidOptions, "frame '{}' is none of robot, base, lidar and camera",
              text);
}

Status BlankView::Check() const {
  constexpr double kWidest_rad = 170.0 * std::numbers::pi / 180.0;
  if (!(field_rad > 0.01 && field_rad <= kWidest_rad))
    return Fail(ErrorCode::kInvalidOptions, "view: a field of {:.1f} deg is not 1 to 170 deg",
                DegreesFromRadians(field_rad));
  if (!std::isfinite(azimuth_rad) || !(std::abs(elevation_rad) <= 0.5 * std::numbers::pi + 1e-9))
    return Fail(ErrorCode::kInvalidOptions, "view: {} and {} deg are no direction",
                DegreesFromRadians(azimuth_rad), DegreesFromRadians(elevation_rad));
  if (width < 16 || height < 16 || width > 8192 || height > 8192)
    return Fail(ErrorCode::kInvalidOptions, "view: {} x {} pixels are not 16 to 8192", width,
                height);
  return {};
}

Status ImportOptions::Check() const {
  if (!up.allFinite() || !(up.norm() > 1e-9))
    return Fail(ErrorCode::kInvalidOptions, "up {},{},{} is no direction", up.x(), up.y(), up.z());
  if (viewpoint && !(viewpoint->allFinite() && viewpoint->norm() <= 1e5))
    return Fail(ErrorCode::kInvalidOptions, "viewpoint {},{},{} is no place within 100 km",
                viewpoint->x(), viewpoint->y(), viewpoint->z());
  if (!(unit_m >= 1e-6 && unit_m <= 1e3))
    return Fail(ErrorCode::kInvalidOptions, "a unit of {} m is not 1 um to 1 km", unit_m);
  if (kitti_camera < 0 || kitti_camera > 3)
    return Fail(ErrorCode::kInvalidOptions, "camera {} of KITTI is not 0 to 3", kitti_camera);
  for (const double angle : image_angles_rad)
    if (!(std::abs(angle) <= ScanPlan::kMaxAngle_rad + 1e-9))
      return Fail(ErrorCode::kInvalidOptions, "an image at {} deg is not within 90 deg",
                  DegreesFromRadians(angle));
  if (frame && *frame != CloudFrame::kRobot && !rig)
    return Fail(ErrorCode::kInvalidOptions, "a frame other than robot needs a rig (--rig)");
  if (rig) FORESIGHT_CHECK(rig->Check());
  if (view) FORESIGHT_CHECK(view->Check());
  return {};
}

std::string ImportedPose::Text() const {
  return fmt::format("{}: a pose in '{}', position ({}) m, quaternion (w, x, y, z) ({})", name,
                     frame, fmt::join(position_m, ", "), fmt::join(rotation_wxyz, ", "));
}

Result<ImportedScan> AssembleScan(ScanParts parts, const ImportOptions& options) {
  return Assembler(std::move(parts), options).Run();
}

}  // namespace foresight
