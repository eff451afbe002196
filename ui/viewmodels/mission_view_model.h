#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "core/mission/mission_file.h"
#include "hardware/head/scan_recorder.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// The mission file. A saved mission is opened read-only and shown as a replay; a new one takes
/// every scan and every object from then on, and those made before.
class MissionViewModel : public QObject {
  Q_OBJECT

 public:
  explicit MissionViewModel(SessionModel* session, QObject* parent = nullptr);

  TaskRunner* Runner() { return &runner_; }
  const std::vector<ScanSummary>& Scans() const { return scans_; }
  int ScanIndex() const { return scan_index_; }
  /// The file that is shown or written, empty when there is none.
  QString Path() const;
  /// How many scans are in memory only.
  int UnsavedScans() const { return static_cast<int>(unsaved_scans_.size()); }

  /// Writes a scan while it arrives, so that a crash loses nothing; nullptr while no file is being
  /// written, or another scan is on its way into it: then the scan is saved at its end.
  std::shared_ptr<ScanSink> Recorder() const;

  void Open(const QString& path);
  void SaveAs(const QString& path);

 public Q_SLOTS:
  /// Shows a scan of the opened mission.
  void showScan(int index);
  /// Keeps a scan that the head has brought home.
  void keepScan(const std::shared_ptr<const foresight::Scan>& scan);
  void keepObject(const foresight::FoundObject& object);

 Q_SIGNALS:
  void changed();

 private:
  struct Opened;
  void ShowOpened(Result<Opened> opened);
  void Save();

  SessionModel* session_;
  TaskRunner runner_;
  std::shared_ptr<MissionFile> file_;
  std::shared_ptr<ScanRecorder> recorder_;  ///< set while the file is ours to write
  std::vector<ScanSummary> scans_;
  int scan_index_ = -1;
  std::vector<std::shared_ptr<const Scan>> unsaved_scans_;
  std::vector<FoundObject> unsaved_objects_;
};

}  // namespace foresight
