#include "ui/views/measurement_lines.h"

#include "core/mapping/measure_in_map.h"

namespace foresight {
namespace {

constexpr Rgb8 kMeasureColor = {240, 228, 66};  // yellow of Okabe and Ito: no verdict has it
constexpr double kCross_m = 0.012;

void AddCross(const Eigen::Vector3d& at, Wireframe* lines) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d half = kCross_m * Eigen::Vector3d::Unit(axis);
    lines->push_back({at - half, at + half});
  }
}

RobotMeasurement Drawn(const Measurement& measurement, const std::string& label, bool selected) {
  RobotMeasurement drawn;
  drawn.lines = MeasurementLines(measurement);
  for (const MeasuredPoint& point : measurement.points) AddCross(point.position_m, &drawn.points);
  drawn.label_at = LabelPlace(measurement);
  drawn.label = label;
  drawn.style = {kMeasureColor, selected ? 3.0f : 1.5f};
  return drawn;
}

/// What was taken so far.
RobotMeasurement Unfinished(const MeasureViewModel& measure) {
  RobotMeasurement drawn;
  std::vector<Eigen::Vector3d> line;
  for (const MeasuredPoint& point : measure.Points()) {
    AddCross(point.position_m, &drawn.points);
    line.push_back(point.position_m);
  }
  if (line.size() > 1) drawn.lines.push_back(line);
  if (measure.PlaneSoFar()) {
    // As it will be drawn with the point that is still missing.
    Measurement plane;
    plane.kind = MeasureKind::kPlaneDistance;
    plane.plane = measure.PlaneSoFar();
    plane.points.emplace_back();
    plane.points.back().position_m = plane.plane->centre;
    drawn.lines.push_back(MeasurementLines(plane).back());
  }
  drawn.style = {kMeasureColor, 2.0f};
  return drawn;
}

/// The measurements that `belongs` takes, and the one that is being taken in that frame.
template <class Belongs>
std::vector<RobotMeasurement> AllThat(const SessionModel& session, const MeasureViewModel& measure,
                                      MeasureFrame frame, const Belongs& belongs) {
  std::vector<RobotMeasurement> all;
  const ShownNote* selected = session.Notes()->Selected();
  for (const ShownNote& note : session.Notes()->All()) {
    if (!note.measurement || note.measurement->frame != frame || !belongs(note)) continue;
    std::string label = ValueText(*note.measurement);
    if (!note.record.text.empty()) label = note.record.text + ": " + label;
    all.push_back(Drawn(*note.measurement, label, &note == selected));
  }
  if (measure.CanTakeBack() && measure.Frame() == frame) all.push_back(Unfinished(measure));
  return all;
}

}  // namespace

std::vector<RobotMeasurement> MeasurementsInRobot(const SessionModel& session,
                                                  const MeasureViewModel& measure) {
  if (!session.ShownScan()) return {};
  return AllThat(session, measure, MeasureFrame::kRobot, [&](const ShownNote& note) {
    return note.record.scan_uuid == session.ShownScan()->uuid;
  });
}

std::vector<RobotMeasurement> MeasurementsInCloud(const SessionModel& session,
                                                  const MeasureViewModel& measure) {
  const MissionMap* map = measure.ShownMapOrNull();
  if (map == nullptr) return MeasurementsInRobot(session, measure);
  return AllThat(session, measure, MeasureFrame::kMap,
                 [&](const ShownNote& note) { return LiesInMap(*map, *note.measurement); });
}

std::vector<PixelMeasurement> MeasurementsInImage(const SessionModel& session,
                                                  const MeasureViewModel& measure) {
  std::vector<PixelMeasurement> all;
  const CameraFrame* frame = session.CurrentImage();
  if (frame == nullptr) return all;
  const SensorRig& rig = session.ShownScan()->rig;
  const auto base_from_robot = rig.robot_from_base.Inverse();
  const auto project = [&](Wireframe lines) {
    for (auto& line : lines)
      for (Eigen::Vector3d& point : line) point = base_from_robot * point;
    return ProjectWireframe(lines, rig, frame->motor_angle_rad);
  };
  for (const RobotMeasurement& one : MeasurementsInRobot(session, measure))
    all.push_back({project(one.lines), project(one.points), PixelInImage(session, one.label_at),
                   one.label, one.style});
  return all;
}

std::optional<Eigen::Vector2d> PixelInImage(const SessionModel& session,
                                            const Eigen::Vector3d& place) {
  const CameraFrame* frame = session.CurrentImage();
  if (frame == nullptr) return std::nullopt;
  const SensorRig& rig = session.ShownScan()->rig;
  const auto pixel = rig.camera.Project(rig.CameraFromBase(frame->motor_angle_rad) *
                                        (rig.robot_from_base.Inverse() * place));
  if (!pixel || pixel->x() < -0.5 || pixel->y() < -0.5 || pixel->x() > rig.camera.width - 0.5 ||
      pixel->y() > rig.camera.height - 0.5)
    return std::nullopt;
  return pixel;
}

}  // namespace foresight
