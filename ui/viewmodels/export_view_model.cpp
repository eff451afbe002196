#include "ui/viewmodels/export_view_model.h"

#include "core/registration/export_cloud.h"

namespace foresight {
ExportViewModel::ExportViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {}

void ExportViewModel::ExportCloud(const QString& path) {
  if (!CanExport()) {
    session_->Report(
        {Notice::Level::kWarning, tr("There is no cloud to export yet."), tr("Press Scan first.")});
    return;
  }
  Scan scan = *session_->CurrentScan();
  scan.rig = session_->Rig();
  const auto work = [cloud = session_->Cloud(), scan, path = path.toStdString()](
                        const RunContext&) { return foresight::ExportCloud(*cloud, scan, path); };
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
