#include "app/ctl/fit_subject.h"

#include <Eigen/Geometry>
#include <cmath>

#include "app/common/output.h"
#include "core/depth/depth_method.h"
#include "core/geometry/angles.h"
#include "core/io/cloud_table.h"
#include "core/io/pfm.h"
#include "core/io/png.h"
#include "core/pictures/cloud_picture.h"
#include "core/pictures/depth_picture.h"
#include "core/pictures/detection_picture.h"
#include "core/pictures/draw.h"

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Metres, NaN = none.
Result<DepthImage> ReadDepth(const std::string& path) {
  if (path.ends_with(".png")) {
    FORESIGHT_TRY(const Image<std::uint16_t> depth_mm, ReadPng16(path));
    DepthImage depth_m(depth_mm.width(), depth_mm.height(), kNaN);
    for (std::size_t i = 0; i < depth_m.values().size(); ++i)
      if (depth_mm.values()[i] > 0)
        depth_m.values()[i] = 1e-3f * static_cast<float>(depth_mm.values()[i]);
    return depth_m;
  }
  FORESIGHT_TRY(DepthImage depth, ReadPfm(path));
  for (float& value : depth.values()) value = value > 0.0f ? 1e-3f * value : kNaN;
  return depth;
}

/// How base lies in a cloud's frame: y points down, z to the cloud's x or, where that is up, y.
Result<Rigid<frame::Robot, frame::Base>> CloudFromBase(const std::vector<double>& up_values) {
  const Eigen::Vector3d given(up_values[0], up_values[1], up_values[2]);
  if (!given.allFinite() || !(given.norm() > 1e-9))
    return Fail(ErrorCode::kInvalidOptions, "--up {},{},{} is no direction", given.x(), given.y(),
                given.z());
  const Eigen::Vector3d up = given.normalized();
  const bool x_is_up = std::abs(up.x()) > 0.9;
  const Eigen::Vector3d ahead = x_is_up ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  Eigen::Matrix3d axes;  // of base, as columns
  axes.col(1) = -up;
  axes.col(2) = (ahead - ahead.dot(up) * up).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return Rigid<frame::Robot, frame::Base>(axes, Eigen::Vector3d::Zero());
}

BoxRoi BoxAround(const std::vector<Eigen::Vector3d>& points) {
  constexpr double kMargin_m = 0.01;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
    if (point.allFinite()) box.extend(point);
  return {{Eigen::Quaterniond::Identity(), box.center()},
          box.sizes() + Eigen::Vector3d::Constant(2.0 * kMargin_m)};
}

/// Says it where the grid that a cloud was measured on is not the file's own: terrain, the noise
/// and the flat surfaces round an object are read off it.
void NoteGrid(const std::string& file, const Result<GridPlaces>& of_table,
              const GridPlaces& taken) {
  if (taken.kind == GridPlaces::Kind::kScattered)
    PrintNote(
        "{}: no order of lines is found in its points. Without their grid terrain is found less "
        "often and edges are less sure. Give a cloud with columns 'line' and 'beam' "
        "(foresightctl cloud writes them), or the mission itself.",
        file);
  else if (!of_table)
    PrintNote("{}: {}. Its grid of {} lines is guessed from the order of its points.", file,
              of_table.error().message, taken.lines);
  else if (taken.kind == GridPlaces::Kind::kSweeps)
    PrintNote(
        "{}: it does not say where its lines are. Its grid of {} lines is guessed from the order "
        "of its points.",
        file, taken.lines);
}

Status OpenCloud(const FitArguments& arguments, FitSubject& subject) {
  FORESIGHT_TRY(const double unit_m, MetresIn(arguments.unit));
  FORESIGHT_TRY(const CloudTable cloud, ReadCloudTable(arguments.cloud_file, unit_m));
  if (arguments.rig.empty()) {
    FORESIGHT_TRY(subject.rig.robot_from_base, CloudFromBase(arguments.up));
  }
  const auto base_from_robot = subject.rig.robot_from_base.Inverse();
  for (const Eigen::Vector3d& point : cloud.points)
    subject.points.push_back(base_from_robot * point);
  subject.viewpoint = base_from_robot * Eigen::Vector3d(arguments.viewpoint.data());
  // Where points of several scans were put together, their numbers are no grid.
  auto places = GridOfTable(cloud, subject.points, subject.viewpoint);
  subject.places = places ? *places : RecoverGrid(subject.points, subject.viewpoint, cloud.ring);
  NoteGrid(arguments.cloud_file, places, subject.places);
  return {};
}

Status OpenDepthMap(const FitArguments& arguments, FitSubject& subject) {
  FORESIGHT_TRY(subject.depth_m, ReadDepth(arguments.depth_file));
  const CameraModel& camera = subject.rig.camera;
  if (subject.depth_m.width() == camera.width && subject.depth_m.height() == camera.height)
    return {};
  return Fail(ErrorCode::kInvalidInput, "{} is {} x {}, but the camera of {} {} x {}",
              arguments.depth_file, subject.depth_m.width(), subject.depth_m.height(),
              arguments.rig, camera.width, camera.height);
}

Status CheckInImage(const Roi& roi, const CameraModel& camera) {
  const auto* image = std::get_if<ImageRoi>(&roi);
  if (image == nullptr) return {};
  const PixelBox box = image->Bounds();
  if (box.high.x() >= 0.0 && box.high.y() >= 0.0 && box.low.x() <= camera.width - 1 &&
      box.low.y() <= camera.height - 1)
    return {};
  return Fail(ErrorCode::kInvalidOptions,
              "region: {:.0f},{:.0f} to {:.0f},{:.0f} lies outside the image of {} x {}",
              box.low.x(), box.low.y(), box.high.x(), box.high.y(), camera.width, camera.height);
}

Result<Detection> FitInPlainRays(const RaysOfRegion& rays_of, const FitSubject& subject,
                                 const std::string& source, const FitOptions& options,
                                 const RunContext& context) {
  FORESIGHT_TRY(Detection detection, FitInRegion(rays_of, {}, subject.roi, options, context));
  OriginOf(detection).roi = subject.roi;
  OriginOf(detection).source = source;
  return detection;
}

/// "-2.1 to 3.4, ... m in x, y, z": where a cloud in millimetres, or in other axes, shows.
std::string ExtentOf(const FitSubject& subject) {
  Eigen::AlignedBox3d extent;
  for (const Eigen::Vector3d& point : subject.points)
    if (point.allFinite()) extent.extend(subject.rig.robot_from_base * point);
  if (extent.isEmpty()) return "no place";
  const Eigen::Vector3d low = extent.min(), high = extent.max();
  return fmt::format("{:.1f} to {:.1f}, {:.1f} to {:.1f}, {:.1f} to {:.1f} m in x, y, z", low.x(),
                     high.x(), low.y(), high.y(), low.z(), high.z());
}

Result<RaySet> RaysInCloudOf(const FitSubject& subject, const FitArguments& arguments,
                             const Roi& roi, BoxRays box_rays) {
  std::optional<double> sigma_m;
  if (arguments.noise_mm > 0.0) sigma_m = 1e-3 * arguments.noise_mm;
  auto rays = RaysInCloud(subject.points, subject.places, subject.viewpoint, subject.rig, roi,
                          sigma_m, box_rays);
  if (!rays && rays.error().code == ErrorCode::kTooFewPoints)
    return Fail(ErrorCode::kTooFewPoints, "{}: its points lie at {}, z up", rays.error().message,
                ExtentOf(subject));
  return rays;
}

/// A scan's depth map by the method that a source names.
Result<DepthResult> DepthFor(const FitSubject& subject, const FitArguments& arguments,
                             const std::string& source, const RunContext& context) {
  FORESIGHT_TRY(const DepthOptions options, DepthOptionsFor(arguments, source));
  return ComputeDepthInFrame(subject.cloud, subject.rig, subject.scan->frame, options, context);
}

ColorImage PictureOfCloud(const FitSubject& subject, const std::vector<Outline>& outlines) {
  std::vector<ColoredPoint> points;
  for (const Eigen::Vector3d& point : subject.points)
    if (point.allFinite()) points.push_back({point.cast<float>(), {120, 140, 165}});
  CloudView view;
  view.eye = subject.viewpoint;
  const auto* box = std::get_if<BoxRoi>(&subject.roi);
  view.target =
      box != nullptr ? box->base_from_box.translation() : outlines.front().lines.front().front();
  ColorImage picture = PaintCloud(points, view);
  for (const Outline& outline : outlines) {
    const bool dashed = outline.level == VerdictLevel::kLikely;
    std::vector<std::vector<Eigen::Vector2d>> lines;
    for (const auto& line : dashed ? Dashed(outline.lines) : outline.lines) {
      lines.emplace_back();
      for (const auto& point : line) lines.back().push_back(ProjectToCloudPicture(point, view));
    }
    DrawPolylines(picture, lines, ColorOf(outline.level),
                  outline.level == VerdictLevel::kUnsure ? 1 : 2);
  }
  return picture;
}

}  // namespace

Result<FitSubject> OpenFitSubject(const FitArguments& arguments, const RunContext& context) {
  FitSubject subject;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(subject.rig, LoadSensorRig(arguments.rig));
  }
  if (arguments.scan.image_deg <= 90.0)
    subject.motor_rad = RadiansFromDegrees(arguments.scan.image_deg);
  if (!arguments.scan.mission.empty()) {
    FORESIGHT_TRY(subject.scan, OpenScan(arguments.scan));
    FORESIGHT_TRY(subject.cloud, RegisterScan(subject.scan->scan, context));
    subject.rig = subject.scan->scan.rig;
    subject.motor_rad = subject.scan->frame.motor_angle_rad;
  } else if (!arguments.depth_file.empty()) {
    FORESIGHT_CHECK(OpenDepthMap(arguments, subject));
  } else {
    FORESIGHT_CHECK(OpenCloud(arguments, subject));
  }
  const RegionArguments& region = arguments.region;
  if (region.rectangle.empty() && region.polygon.empty() && region.two_clicks.empty() &&
      region.box.empty()) {
    subject.roi = BoxAround(subject.points);
    const Status sound = CheckRoi(subject.roi);
    if (!sound)
      return Fail(ErrorCode::kInvalidInput, "{}: all of its points: {}; give a smaller --box",
                  arguments.cloud_file, sound.error().message);
    return subject;
  }
  FORESIGHT_TRY(subject.roi, RegionFrom(region, subject.motor_rad, subject.rig.robot_from_base));
  FORESIGHT_CHECK(CheckInImage(subject.roi, subject.rig.camera));
  return subject;
}

FitSource FitSourceOf(const std::string& source) {
  if (source == "raw") return FitSource::kRaw;
  return source.ends_with(kAloneSuffix) ? FitSource::kDepthAlone : FitSource::kDepth;
}

Result<DepthOptions> DepthOptionsFor(const FitArguments& arguments, const std::string& source) {
  DepthArguments depth_arguments = arguments.depth;
  if (const auto named = FitSourceFromName(source))
    depth_arguments.method = InfoOf(named->method).name;
  return DepthOptionsFrom(depth_arguments);
}

FitAnswer FitIn(const FitSubject& subject, const FitArguments& arguments, const std::string& source,
                const RunContext& context) {
  const auto options = FitOptionsFrom(arguments, subject.rig.robot_from_base);
  if (!options) return {tl::unexpected(options.error()), {}};
  if (!subject.depth_m.empty())
    return {FitInPlainRays(
                [&](const Roi& roi, BoxRays box) {
                  return RaysInDepthMap(subject.depth_m, subject.rig, subject.motor_rad, roi,
                                        arguments.density, box);
                },
                subject, "depth map", *options, context),
            {}};
  if (!subject.scan)
    return {FitInPlainRays([&](const Roi& roi,
                               BoxRays box) { return RaysInCloudOf(subject, arguments, roi, box); },
                           subject, "cloud", *options, context),
            {}};
  if (source == "raw")
    return {FitInScan({subject.rig, subject.cloud, subject.scan->scan.frames}, FitSource::kRaw,
                      subject.roi, *options, context),
            {}};
  auto depth = DepthFor(subject, arguments, source, context.Part(0.0, 0.6));
  if (!depth) return {tl::unexpected(depth.error()), {}};
  auto detection = FitInScan({subject.rig, subject.cloud, subject.scan->scan.frames, &*depth},
                             FitSourceOf(source), subject.roi, *options, context.Part(0.6, 1.0));
  return {std::move(detection), std::move(*depth)};
}

bool IsNegative(const Error& error) {
  return error.code == ErrorCode::kTooFewPoints || error.code == ErrorCode::kNoConvergence;
}

ColorImage PictureOf(const FitSubject& subject, const Detection& detection) {
  return PictureOf(subject, OutlinesOf(detection, 0));
}

ColorImage PictureOf(const FitSubject& subject, const std::vector<Outline>& outlines) {
  if (!subject.points.empty()) return PictureOfCloud(subject, outlines);
  ColorImage picture;
  if (subject.scan) {
    picture = subject.scan->frame.image;
  } else {
    const MaskImage all(subject.depth_m.width(), subject.depth_m.height(), 255);
    picture =
        PaintDepth(subject.depth_m, nullptr, ColorMap::kTurbo, DepthRangeOf(subject.depth_m, all));
  }
  DrawRegion(picture, subject.roi, subject.rig, subject.motor_rad);
  DrawOutlines(picture, outlines, subject.rig, subject.motor_rad);
  return picture;
}

}  // namespace foresight
