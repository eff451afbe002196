#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/mission/mission_file.h"
#include "ui/viewmodels/review_scan.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// A mission file that is open for review.
struct OpenMission {
  std::shared_ptr<MissionFile> file;
  std::vector<ScanSummary> scans;

  QString Path() const { return QString::fromStdString(file->path().string()); }
};

/// Mission files that are looked at, read-only; also the one that is being recorded. One scan of
/// one of them is shown. What is found in a mission meanwhile is kept in a file beside it. Touches
/// neither the head nor the recording.
class ReviewViewModel : public QObject {
  Q_OBJECT

 public:
  explicit ReviewViewModel(SessionModel* review, QObject* parent = nullptr);

  /// All that are open, in the order in which they were opened.
  const std::vector<OpenMission>& Missions() const { return missions_; }
  /// The one whose scan is shown; -1 = none.
  int MissionIndex() const { return mission_index_; }

  /// Of the mission that is shown; empty when nothing is open.
  QString Path() const;
  std::shared_ptr<MissionFile> File() const;
  const std::vector<ScanSummary>& Scans() const;
  int ScanIndex() const { return scan_index_; }
  TaskRunner* Runner() { return &loader_; }
  bool Busy() const { return loader_.Busy() || writer_.Busy() || copier_.Busy(); }

  /// Opens the file, unless it is open already, and shows its last scan, or the one with
  /// `scan_uuid`; selects the object with `object_uuid`.
  void Open(const QString& path, const std::string& scan_uuid = {},
            const std::string& object_uuid = {});
  /// Opens all of them and shows the last one. What cannot be opened is reported, one notice each.
  void OpenAll(const QStringList& paths);
  void ShowScanOf(int mission, int scan);
  /// Closes one of them. Where it was shown, the one before it is, if there is one.
  void CloseMission(int index);
  void CopyTo(const QString& path);
  /// Writes into the review of the mission that is open, in the order of the calls; `kept` is told
  /// how that ended, in this thread.
  void Keep(std::function<Status(MissionFile*)> body, std::function<void(const Status&)> kept);
  /// The same beside a mission that need not be the open one any more: what was begun in it belongs
  /// to it.
  void KeepIn(const std::filesystem::path& mission, std::function<Status(MissionFile*)> body,
              std::function<void(const Status&)> kept);

  /// The session shows another scan of this mission now: a replay went on to it.
  void Follow(int scan, const std::vector<FoundObject>& objects);

 public Q_SLOTS:
  void showScan(int index);
  /// Shows the scan of this mission with this uuid, if it is not shown already.
  void showScanWith(const QString& uuid);
  /// Closes the mission that is shown.
  void close();

 Q_SIGNALS:
  /// A scan is shown that was asked for.
  void opened();
  /// What was asked for could not be shown; the session was told why.
  void notOpened();
  void changed();
  /// Something was written into the file beside the mission.
  void reviewKept();

 private:
  struct Opened;
  struct Wanted;
  void Load(const QString& title, Wanted wanted);
  static Result<Opened> LoadWanted(const Wanted& wanted, const RunContext& context);
  int MissionAt(const std::filesystem::path& path) const;
  void List(OpenMission mission);
  void Show(Opened opened);
  void Write(std::function<Status(MissionFile*)> body, const std::string& object_uuid);

  SessionModel* session_;
  TaskRunner loader_{session_->Tasks()};
  TaskRunner writer_{session_->Tasks(), TaskPolicy::kNeverCancel};
  TaskRunner copier_{session_->Tasks(), TaskPolicy::kQueue};
  std::vector<OpenMission> missions_;
  int mission_index_ = -1;
  int scan_index_ = -1;
  std::map<std::string, FoundObject> known_;  ///< of the scan that is shown, by uuid
};

}  // namespace foresight
