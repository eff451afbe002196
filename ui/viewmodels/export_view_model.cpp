#include "ui/viewmodels/export_view_model.h"

#include "core/depth/depth_method.h"
#include "core/exchange/export_mission.h"
#include "core/registration/export_cloud.h"
#include "core/report/mission_report.h"
#include "ui/viewmodels/review_scan.h"
#include "ui/viewmodels/review_view_model.h"

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

void ExportViewModel::ExportMission(const QString& mission, const QString& folder) {
  const std::filesystem::path file = mission.toStdString();
  const std::filesystem::path target =
      std::filesystem::path(folder.toStdString()) / (file.stem().string() + "-export");
  const auto work = [file, target](const RunContext& context) -> Result<MissionExportReport> {
    MissionExportOptions options;
    options.depth = DefaultsOf(DepthMethod::kForesight);
    FORESIGHT_TRY(const auto opened, MissionFile::OpenReadOnly(file));
    return foresight::ExportMission(*opened, target, options, context);
  };
  const QString doing = tr("Exporting the mission");
  mission_runner_.Run<MissionExportReport>(
      doing, work, [this, doing, target](const Result<MissionExportReport>& report) {
        if (!report) {
          session_->Report(NoticeOf(doing, report.error()));
          return;
        }
        const QString wrote = tr("Wrote %1 files to %2.")
                                  .arg(static_cast<qulonglong>(report->files.size()))
                                  .arg(QString::fromStdString(target.string()));
        if (report->left_out.empty())
          session_->Report({Notice::Level::kInfo, wrote, {}});
        else
          session_->Report({Notice::Level::kWarning, wrote,
                            tr("Left out: %1").arg(QString::fromStdString(report->left_out[0]))});
      });
}

void ExportViewModel::WriteReport(const QString& mission, const std::string& scan_uuid,
                                  const QString& folder) {
  const QString doing = tr("Writing the report");
  const std::filesystem::path file = mission.toStdString();
  const std::filesystem::path target =
      std::filesystem::path(folder.toStdString()) / (file.stem().string() + "-report");
  const auto work = [file, target, scan_uuid, reviews = ReviewFolder()](
                        const RunContext& context) -> Result<MissionReportFiles> {
    FORESIGHT_TRY(const auto opened, MissionFile::OpenReadOnly(file));
    FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(file, reviews));
    MissionReportOptions options{std::nullopt, true};
    if (!scan_uuid.empty()) {
      FORESIGHT_TRY(options.scan, opened->FindScan(scan_uuid));
      if (!options.scan)
        return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", file.string(), scan_uuid);
    }
    std::error_code error;
    std::filesystem::create_directories(target, error);
    if (error) return Fail(ErrorCode::kIo, "{}: {}", target.string(), error.message());
    return WriteMissionReport(*opened, review.get(), target, options, context);
  };
  mission_runner_.Run<MissionReportFiles>(
      doing, work, [this, doing, target](const Result<MissionReportFiles>& report) {
        if (!report) {
          session_->Report(NoticeOf(doing, report.error()));
          return;
        }
        const QString wrote = tr("Wrote report.html and report.pdf of %1 scans to %2.")
                                  .arg(report->scans)
                                  .arg(QString::fromStdString(target.string()));
        if (report->left_out.empty())
          session_->Report({Notice::Level::kInfo, wrote, {}});
        else
          session_->Report({Notice::Level::kWarning, wrote,
                            tr("Left out: %1").arg(QString::fromStdString(report->left_out[0]))});
      });
}

void ExportViewModel::WriteBundle(const QString& path, const SupportBundleSources& sources) {
  const QString doing = tr("Writing the support bundle");
  const auto work = [path = path.toStdString(), sources](const RunContext& context) {
    return WriteSupportBundle(path, sources, context);
  };
  mission_runner_.Run<SupportBundleReport>(
      doing, work, [this, doing, path](const Result<SupportBundleReport>& report) {
        if (!report)
          session_->Report(NoticeOf(doing, report.error()));
        else
          session_->Report({Notice::Level::kInfo,
                            tr("Wrote %1 files to %2.")
                                .arg(static_cast<qulonglong>(report->files.size()))
                                .arg(path),
                            {}});
      });
}

}  // namespace foresight
