#include "app/ctl/demo_report.h"

#include "core/geometry/angles.h"
#include "core/pictures/cloud_picture.h"
#include "core/pictures/depth_picture.h"
#include "core/pictures/detection_picture.h"
#include "core/pictures/draw.h"
#include "core/pictures/sample_picture.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

constexpr Rgb8 kTemplate{0, 255, 200};

HtmlReport::Table ScanTable(const DemoOutcome& o) {
  const ScanPlan& plan = o.scan.plan;
  return {"Scan",
          {{"head", o.scan.source},
           {"rig", fmt::format("{}, {}", o.scan.rig.name, ShortRigId(o.scan.rig))},
           {"camera model", std::string(o.scan.rig.camera.Name())},
           {"state", ToString(o.scan.state)},
           {"scope",
            fmt::format("{:.0f} to {:.0f} deg at {:.0f} deg/s", DegreesFromRadians(plan.from_rad),
                        DegreesFromRadians(plan.to_rad), DegreesFromRadians(plan.speed_rad_s))},
           {"lines", fmt::format("{}", o.scan.lines.size())},
           {"images", fmt::format("{}", o.scan.frames.size())},
           {"mission file", o.mission_file}}};
}

HtmlReport::Table DepthTable(const DemoOutcome& o) {
  std::size_t count[4] = {};
  for (const RejectReason reason : o.depth.samples.reasons) ++count[static_cast<int>(reason)];
  std::size_t kept_pixels = 0;
  for (const auto value : o.depth.mask.values()) kept_pixels += value != 0 ? 1 : 0;
  const auto text = [&](RejectReason reason) {
    return fmt::format("{}", count[static_cast<int>(reason)]);
  };
  return {"Depth",
          {{"samples in the image",
            fmt::format("{} ({:.1f} % of the pixels where the lidar looked)",
                        o.depth.samples.samples.size(), 100.0 * LocalDensity(o.depth.samples))},
           {"flying, rejected", text(RejectReason::kFlying)},
           {"isolated, rejected", text(RejectReason::kIsolated)},
           {"flipping, rejected", text(RejectReason::kFlipping)},
           {"sigma_s", fmt::format("{:.1f} px", o.depth.dense.sigma_spatial_px)},
           {"kept by the mask",
            fmt::format("{:.1f} % of the pixels", 100.0 * static_cast<double>(kept_pixels) /
                                                      static_cast<double>(o.depth.mask.size()))},
           {"time", fmt::format("{:.2f} s", o.depth.seconds)}}};
}

HtmlReport::Table ValveTable(const DemoOutcome& o) {
  const ValveCandidate& best = o.valve.best;
  const Eigen::Vector3d center =
      1000.0 * (o.scan.rig.robot_from_base * best.base_from_object.translation());
  const Eigen::Vector3d axis =
      o.scan.rig.robot_from_base.Rotate(best.base_from_object.Rotate(Eigen::Vector3d::UnitZ()));
  return {"Valve",
          {{"verdict",
            fmt::format("{} ({}): {}", ToString(o.valve.verdict.level),
                        ProbabilityText(o.valve.verdict.probability), o.valve.verdict.reason)},
           {"centre in robot",
            fmt::format("{:.1f}, {:.1f}, {:.1f} mm", center.x(), center.y(), center.z())},
           {"axis in robot", fmt::format("{:.4f}, {:.4f}, {:.4f}", axis.x(), axis.y(), axis.z())},
           {"rim diameter", fmt::format("{:.1f} mm", 2000.0 * best.model.rim_radius_m)},
           {"spokes", fmt::format("{}", best.model.spokes)},
           {"rays", fmt::format("{}, {} hits, {:.0f} % agree", o.valve.evidence.rays,
                                o.valve.evidence.hits, 100.0 * o.valve.evidence.inlier_ratio)},
           {"time", fmt::format("{:.2f} s", o.valve.origin.seconds)}}};
}

HtmlReport::Table TruthTable(const DemoOutcome& o) {
  return {"Against the simulated truth",
          {{"centre", fmt::format("{:.1f} mm off", 1000.0 * o.error.center_m)},
           {"axis", fmt::format("{:.2f} deg off", DegreesFromRadians(o.error.axis_rad))},
           {"rim radius", fmt::format("{:+.1f} mm", 1000.0 * o.error.radius_m)},
           {"spokes", o.error.spokes == 0 ? "right" : fmt::format("{:+d}", o.error.spokes)}}};
}

/// The cloud with the picture's colours where the camera saw it, grey elsewhere.
ColorImage CloudPicture(const DemoOutcome& o) {
  const auto camera_from_base = o.scan.rig.CameraFromBase(o.frame.motor_angle_rad);
  std::vector<ColoredPoint> points;
  for (std::size_t i = 0; i < o.registered.points.size(); ++i) {
    if (!(o.registered.range_m[i] > 0.0f)) continue;
    const Eigen::Vector3f& point = o.registered.points[i];
    const auto pixel = o.scan.rig.camera.Project(camera_from_base * point.cast<double>());
    Rgb8 color{90, 94, 102};
    if (pixel && o.scan.rig.camera.InImage(*pixel))
      color = o.frame.image(static_cast<int>(pixel->x() + 0.5), static_cast<int>(pixel->y() + 0.5));
    points.push_back({point, color});
  }
  const Eigen::Vector3d target = o.valve.best.base_from_object.translation();
  CloudView view;
  view.target = Eigen::Vector3d(0.4 * target.x(), target.y() + 0.2, target.z());
  view.eye = Eigen::Vector3d(1.1, -0.8, -1.2);
  ColorImage picture = PaintCloud(points, view);
  std::vector<std::vector<Eigen::Vector2d>> lines;
  for (const auto& line : WireframeOf(o.valve.best.model)) {
    lines.emplace_back();
    for (const auto& point : line)
      lines.back().push_back(ProjectToCloudPicture(o.valve.best.base_from_object * point, view));
  }
  DrawPolylines(picture, lines, kTemplate, 2);
  return picture;
}

ColorImage WithOverlay(ColorImage picture, const DemoOutcome& o) {
  DrawDetection(picture, o.valve, 0, o.scan.rig, o.frame.motor_angle_rad);
  return picture;
}

}  // namespace

HtmlReport ReportOf(const DemoOutcome& o) {
  const ValueRange range = DepthRangeOf(o.depth.dense.depth_m, o.depth.mask);
  const std::string span = fmt::format("Blue is {:.2f} m, red {:.2f} m.", range.low, range.high);
  const ColorImage masked = PaintDepth(o.depth.dense, &o.depth.mask, DepthLayer::kDepth, range);
  HtmlReport report;
  report.title = "Demo mission";
  report.summary = fmt::format(
      "A simulated head scanned a room; a valve was fitted in the region drawn round it: {}, "
      "{:.1f} mm and {:.2f} deg "
      "from the truth.",
      ToString(o.valve.verdict.level), 1000.0 * o.error.center_m,
      DegreesFromRadians(o.error.axis_rad));
  report.tables = {ScanTable(o), DepthTable(o), ValveTable(o), TruthTable(o), o.sources};
  report.pictures = {
      {"image.png", "Image", "What the camera saw.", o.frame.image},
      {"samples.png", "Raw samples",
       "Lidar returns in the image. " + span +
           " Orange: flying, light blue: isolated, pink: flipping.",
       PaintSamples(o.depth.samples, range)},
      {"depth.png", "Depth", "Upsampled, nothing masked. " + span,
       PaintDepth(o.depth.dense, nullptr, DepthLayer::kDepth, range)},
      {"confidence.png", "Confidence", "Relative to the largest; yellow is high.",
       PaintDepth(o.depth.dense, nullptr, DepthLayer::kConfidence, {0.0, 1.0})},
      {"masked.png", "Masked depth", "Hatched pixels are not to be trusted. " + span, masked},
      {"cloud.png", "Cloud", "The lidar's points from above and aside, with the fitted template.",
       CloudPicture(o)},
      {"overlay.png", "Fit on the image", "Yellow: the region; green: the fitted template.",
       WithOverlay(o.frame.image, o)},
      {"overlay-depth.png", "Fit on the masked depth",
       "Yellow: the region; green: the fitted template.", WithOverlay(masked, o)}};
  report.pictures.insert(report.pictures.end(), o.source_pictures.begin(), o.source_pictures.end());
  return report;
}

}  // namespace foresight
