#include "ui/viewmodels/export_view_model.h"

#include "core/io/point_cloud_file.h"

namespace foresight {
namespace {

std::vector<CloudPoint> PointsInRobot(const RegisteredScan& scan, const SensorRig& rig) {
  std::vector<CloudPoint> points;
  for (int line = 0; line < scan.lines; ++line) {
    for (int beam = 0; beam < scan.beams; ++beam) {
      if (!scan.Valid(line, beam)) continue;
      const std::size_t index = scan.Index(line, beam);
      const Eigen::Vector3f point =
          (rig.robot_from_base * scan.points[index].cast<double>()).cast<float>();
      points.push_back(
          {point.x(), point.y(), point.z(), scan.intensity[index], line, beam, Rgb8()});
    }
  }
  return points;
}

}  // namespace

ExportViewModel::ExportViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {}

void ExportViewModel::ExportCloud(const QString& path) {
  if (!CanExport()) {
    session_->Report(
        {Notice::Level::kWarning, tr("There is no cloud to export yet."), tr("Press Scan first.")});
    return;
  }
  const auto work = [cloud = session_->Cloud(), rig = session_->Rig(),
                     path = path.toStdString()](const RunContext&) -> Result<std::size_t> {
    const std::vector<CloudPoint> points = PointsInRobot(*cloud, rig);
    FORESIGHT_CHECK(WritePly(path, points, CloudColors::kNone));
    return points.size();
  };
  runner_.Run<std::size_t>(
      tr("Exporting the cloud"), work, [this, path](const Result<std::size_t>& written) {
        if (!written) {
          session_->Report(NoticeOf(tr("Exporting the cloud"), written.error()));
          return;
        }
        session_->Report({Notice::Level::kInfo,
                          tr("Wrote %1 points in the robot's frame to %2.")
                              .arg(static_cast<qulonglong>(*written))
                              .arg(path),
                          {}});
      });
}

}  // namespace foresight
