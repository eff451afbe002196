#pragma once

#include <QObject>
#include <QString>
#include <string>

#include "core/exchange/support_bundle.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Writes what is on the screen, and whole missions, for other programs.
class ExportViewModel : public QObject {
  Q_OBJECT

 public:
  explicit ExportViewModel(SessionModel* session, QObject* parent = nullptr);

  TaskRunner* Runner() { return &runner_; }
  bool CanExport() const { return session_->CurrentScan() && session_->Cloud(); }
  /// The lidar's points in the robot's frame, metres, as binary PLY.
  void ExportCloud(const QString& path);

  /// Everything of a mission (core/exchange/export_mission.h), with the default depth method, into
  /// `NAME-export` in `folder`; also of one that is being recorded. One after the other, each can
  /// be cancelled.
  void ExportMission(const QString& mission, const QString& folder);
  /// A page of the mission with pictures, and the same as PDF (core/report/mission_report.h), into
  /// `NAME-report` in `folder`; of the scan with this uuid alone, where one is given.
  void WriteReport(const QString& mission, const std::string& scan_uuid, const QString& folder);
  /// What somebody needs who has to find out what went wrong (core/exchange/support_bundle.h).
  void WriteBundle(const QString& path, const SupportBundleSources& sources);
  TaskRunner* MissionRunner() { return &mission_runner_; }

 private:
  SessionModel* session_;
  TaskRunner runner_{session_->Tasks()};
  TaskRunner mission_runner_{session_->Tasks(), TaskPolicy::kQueue};
};

}  // namespace foresight
