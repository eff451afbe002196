#include "ui/views/outlines.h"

#include "core/detection/outline.h"
#include "core/pictures/detection_picture.h"

namespace foresight {
namespace {

OutlineStyle StyleOf(const Outline& outline, bool selected) {
  if (outline.level == VerdictLevel::kUnsure) return {ColorOf(outline.level), 1.0f};
  return {ColorOf(outline.level), selected && outline.chosen ? 3.0f : 2.0f};
}

/// Calls `draw` with every outline of the current scan.
template <class Draw>
void ForEachOutline(const SessionModel& session, const Draw& draw) {
  const auto& objects = session.Objects();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!session.IsCurrent(objects[i])) continue;
    const bool selected = static_cast<int>(i) == session.SelectedObject();
    for (const Outline& outline : OutlinesOf(objects[i].detection, session.CandidateOf(i)))
      draw(objects[i].rig,
           outline.level == VerdictLevel::kLikely ? Dashed(outline.lines) : outline.lines,
           StyleOf(outline, selected));
  }
}

}  // namespace

std::vector<PixelOutline> OutlinesInImage(const SessionModel& session) {
  std::vector<PixelOutline> all;
  const CameraFrame* capture = session.CurrentImage();
  if (capture == nullptr) return all;
  ForEachOutline(session,
                 [&](const SensorRig& rig, const Wireframe& lines, const OutlineStyle& style) {
                   all.push_back({ProjectWireframe(lines, rig, capture->motor_angle_rad), style});
                 });
  return all;
}

std::vector<RobotOutline> OutlinesInRobot(const SessionModel& session) {
  std::vector<RobotOutline> all;
  ForEachOutline(session,
                 [&](const SensorRig& rig, const Wireframe& lines, const OutlineStyle& style) {
                   all.push_back({WireframeInRobot(lines, rig), style});
                 });
  return all;
}

PixelLines RegionInImage(const SessionModel& session) {
  const CameraFrame* capture = session.CurrentImage();
  if (capture == nullptr || !session.Region()) return {};
  return RegionLines(*session.Region(), session.ShownScan()->rig, capture->motor_angle_rad);
}

Wireframe RegionInRobot(const SessionModel& session) {
  if (!session.ShownScan() || !session.Region()) return {};
  const auto* box = std::get_if<BoxRoi>(&*session.Region());
  if (box == nullptr) return {};
  return WireframeInRobot(WireframeOf(*box), session.ShownScan()->rig);
}

}  // namespace foresight
