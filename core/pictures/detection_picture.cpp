#include "core/pictures/detection_picture.h"

#include <cmath>

#include "core/pictures/draw.h"

namespace foresight {
namespace {

constexpr Rgb8 kRim = {16, 20, 26};
constexpr Rgb8 kRegion = {255, 255, 255};

void DrawOutline(ColorImage& picture, const Outline& outline, const SensorRig& rig,
                 double motor_rad) {
  const bool dashed = outline.level == VerdictLevel::kLikely;
  const PixelLines lines =
      ProjectWireframe(dashed ? Dashed(outline.lines) : outline.lines, rig, motor_rad);
  if (outline.level == VerdictLevel::kUnsure) {
    DrawPolylines(picture, lines, ColorOf(outline.level), 1);
    return;
  }
  const int thickness_px = outline.chosen ? 2 : 1;
  DrawPolylines(picture, lines, kRim, thickness_px + 2);
  DrawPolylines(picture, lines, ColorOf(outline.level), thickness_px);
}

}  // namespace

Rgb8 ColorOf(VerdictLevel level) {
  switch (level) {
    case VerdictLevel::kConfirmed:
      return {0, 200, 140};
    case VerdictLevel::kLikely:
      return {255, 176, 0};
    case VerdictLevel::kUnsure:
      break;
  }
  return {176, 182, 190};
}

void DrawDetection(ColorImage& picture, const Detection& detection, int candidate,
                   const SensorRig& rig, double motor_rad) {
  DrawRegion(picture, OriginOf(detection).roi, rig, motor_rad);
  DrawOutlines(picture, OutlinesOf(detection, candidate), rig, motor_rad);
}

void DrawOutlines(ColorImage& picture, const std::vector<Outline>& outlines, const SensorRig& rig,
                  double motor_rad) {
  for (const Outline& outline : outlines) DrawOutline(picture, outline, rig, motor_rad);
}

PixelLines RegionLines(const Roi& roi, const SensorRig& rig, double motor_rad) {
  constexpr double kSameImage_rad = 1e-6;
  if (const auto* box = std::get_if<BoxRoi>(&roi))
    return ProjectWireframe(WireframeOf(*box), rig, motor_rad);
  const auto& image = std::get<ImageRoi>(roi);
  if (image.polygon.empty() || std::abs(image.motor_rad - motor_rad) > kSameImage_rad) return {};
  PixelLines lines = {image.polygon};
  lines.front().push_back(lines.front().front());
  return lines;
}

void DrawRegion(ColorImage& picture, const Roi& roi, const SensorRig& rig, double motor_rad) {
  DrawPolylines(picture, RegionLines(roi, rig, motor_rad), kRegion, 1);
}

ColorImage AroundRegion(const ColorImage& picture, const Roi& roi) {
  const auto* image = std::get_if<ImageRoi>(&roi);
  if (image == nullptr) return picture;
  const Eigen::Vector2d last(picture.width() - 1, picture.height() - 1);
  const PixelBox box = image->Bounds();
  const Eigen::Vector2d margin = 0.5 * (box.high - box.low);
  const auto in_image = [&last](const Eigen::Vector2d& pixel) -> Eigen::Vector2i {
    return pixel.cwiseMax(Eigen::Vector2d::Zero()).cwiseMin(last).cast<int>();
  };
  const Eigen::Vector2i low = in_image(box.low - margin), high = in_image(box.high + margin);
  ColorImage part(high.x() - low.x() + 1, high.y() - low.y() + 1);
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x) part(x, y) = picture(x + low.x(), y + low.y());
  return part;
}

Wireframe WireframeOf(const BoxRoi& box) {
  SolidPart part;
  part.size_m = box.size_m;
  Wireframe lines = WireframeOf(part);
  for (auto& line : lines)
    for (auto& point : line) point = box.base_from_box * point;
  return lines;
}

}  // namespace foresight
