#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/mission/mission_file.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// A mission file that is looked at, read-only; also the one that is being recorded. What is found
/// in it meanwhile is kept in a file beside it. Touches neither the head nor the recording.
class ReviewViewModel : public QObject {
  Q_OBJECT

 public:
  explicit ReviewViewModel(SessionModel* review, QObject* parent = nullptr);

  /// Empty when nothing is open.
  QString Path() const;
  const std::vector<ScanSummary>& Scans() const { return scans_; }
  int ScanIndex() const { return scan_index_; }
  TaskRunner* Runner() { return &loader_; }
  bool Busy() const { return loader_.Busy() || writer_.Busy() || copier_.Busy(); }

  /// Opens the file and shows its last scan, or the one with `scan_uuid`.
  void Open(const QString& path, const std::string& scan_uuid = {});
  void CopyTo(const QString& path);
  /// The mission; nullptr when nothing is open.
  std::shared_ptr<const MissionFile> File() const { return file_; }
  /// Where reviews lie whose mission's folder cannot be written.
  static std::filesystem::path ReviewFolder();
  /// Writes into the review of the mission that is open, in the order of the calls; `kept` is told
  /// how that ended, in this thread.
  void Keep(std::function<Status(MissionFile*)> body, std::function<void(const Status&)> kept);

 public Q_SLOTS:
  void showScan(int index);
  void close();

 Q_SIGNALS:
  void opened();
  void changed();

 private:
  struct Opened;
  void Load(const QString& title, std::shared_ptr<MissionFile> file, const std::string& path,
            const std::string& scan_uuid);
  void Show(Opened opened);
  void Write(std::function<Status(MissionFile*)> body, const std::string& object_uuid);

  SessionModel* session_;
  TaskRunner loader_{session_->Tasks()};
  TaskRunner writer_{session_->Tasks(), TaskPolicy::kNeverCancel};
  TaskRunner copier_{session_->Tasks(), TaskPolicy::kQueue};
  std::shared_ptr<MissionFile> file_;
  std::vector<ScanSummary> scans_;
  int scan_index_ = -1;
  std::map<std::string, FoundObject> known_;  ///< of the scan that is shown, by uuid
};

}  // namespace foresight
