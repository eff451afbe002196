#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <deque>
#include <memory>
#include <variant>
#include <vector>

#include "core/mission/kept_check.h"
#include "core/mission/mission_file.h"
#include "hardware/head/scan_recorder.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// The mission file of the live session. Everything goes into it as it comes: lines while the head
/// sweeps, objects and decisions as they are made. What cannot be written stays in memory, is said,
/// and is written as soon as a file takes it.
class RecordingViewModel : public QObject {
  Q_OBJECT

 public:
  explicit RecordingViewModel(SessionModel* live, QObject* parent = nullptr);
  /// Closes the file; a file that nothing was recorded into is removed. Call WriteAll first.
  ~RecordingViewModel() override;

  /// Where missions go unless the operator says otherwise; made if it is not there.
  static QString DefaultFolder();
  /// Mission files in a folder whose program ended without closing them, newest first.
  static QStringList LeftBehind(const QString& folder);

  /// Records into this file from now on: a new one, or one that is continued. Takes some
  /// milliseconds; for the start of the program. Where another program still writes the file, as
  /// one that was killed does for some seconds, it is tried again until it is free.
  bool Begin(const QString& path);
  /// The same with a new file named after the date.
  bool BeginInFolder(const QString& folder);
  /// The same while the program runs: what waits goes into the new file. Where the present one was
  /// moved or deleted, only a new name is taken, and begins with all that it holds. Not during a
  /// sweep.
  void SwitchTo(const QString& path);

  /// Says that a program left a mission in `folder`, or the one at `last_path`, without closing it,
  /// and offers to go on in it; looks again for some seconds, as a killed program may take as long
  /// to let go of its file. Call it before Begin.
  void OfferInterrupted(const QString& folder, const QString& last_path = {});
  /// The mission that is offered; empty = none.
  QString Interrupted() const { return interrupted_; }

  QString Path() const { return path_; }
  bool Recording() const { return recorder_ != nullptr; }
  /// What waits cannot be written: there is no file, or it did not take the last of it.
  bool Stuck() const { return Waiting() > 0 && (failed_ || !Recording()); }
  /// Whether the file was moved or deleted under the recording: what it holds may be lost.
  bool FileHasMoved() const { return file_ && file_->HasMoved(); }
  /// Whether something may be lost unless the operator chooses another file. Asks no file system: a
  /// file that moved is known some seconds later.
  bool NeedsOperator() const { return Stuck() || moved_; }
  /// Whether nothing is lost when the program ends now.
  bool AllIsSafe() const { return Waiting() == 0 && !FileHasMoved(); }
  /// The file that is recorded into; nullptr while there is none.
  std::shared_ptr<MissionFile> File() const { return file_; }
  /// The sink that writes a scan while it arrives; nullptr while there is no file to write.
  std::shared_ptr<ScanSink> Recorder() const { return recorder_; }
  /// All scans of the file, oldest first, the running one too.
  const std::vector<ScanSummary>& Scans() const { return scans_; }
  /// How many scans, objects and decisions are in memory only.
  int Waiting() const;
  bool Busy() const { return writer_.Busy() || reader_.Busy() || copier_.Busy(); }

  /// Before the program ends: runs the event loop until nothing waits. False where something still
  /// does, because it cannot be written or took longer than `limit_ms`.
  bool WriteAll(int limit_ms = 20'000);

  /// A complete copy of what is in the file now, in one file; recording goes on where it is.
  void CopyTo(const QString& path);

 public Q_SLOTS:
  /// Writes what waits again, after the operator has made room.
  void tryAgain();
  /// Records into the interrupted mission from now on. Not during a sweep.
  void continueInterrupted();
  void refreshList();
  /// A scan has ended: makes sure that all of it is on the disk.
  void keepScan(const std::shared_ptr<const foresight::Scan>& scan);
  void keepObject(const foresight::FoundObject& object);
  void keepObjectEvent(const foresight::ObjectEvent& event);
  /// Notes how the session's depth map is made again.
  void keepDepth();
  void keepNote(const foresight::NoteRecord& note);
  /// What a scan of this session said about itself.
  void keepCheck(const foresight::KeptCheck& check);
  /// For the mission's log.
  void keepNotice(const foresight::Notice& notice);
  void keepCommand(const QString& id);
  /// The link to the head came or went.
  void keepLink(bool connected);

 Q_SIGNALS:
  void changed();
  void allWritten();        ///< nothing waits any more
  void interruptedTaken();  ///< the interrupted mission is no longer offered

 private:
  /// A depth map that was made of a recorded scan.
  struct MadeDepth {
    std::shared_ptr<const Scan> scan;
    std::shared_ptr<const DepthResult> depth;
  };
  using Change = std::variant<std::shared_ptr<const Scan>, FoundObject, ObjectEvent, MadeDepth,
                              NoteRecord, KeptCheck, EventRecord>;

  /// Whether a mission is offered now.
  bool Offer(const QString& folder, const QString& last_path);
  /// Says it once when the file has been moved or deleted under the recording; without a file,
  /// begins with the one that is wanted when nobody writes it any more.
  void LookAfterFile();
  void TellWhetherItMoved(bool moved);
  void Keep(Change change);
  void WriteNext();
  /// `earlier`: what it held before this sitting writes into it.
  void Use(std::shared_ptr<MissionFile> file, const EarlierContents& earlier);
  Status Open(const QString& path, std::shared_ptr<MissionFile>* file) const;

  SessionModel* session_;
  TaskRunner writer_{session_->Tasks(), TaskPolicy::kNeverCancel};
  TaskRunner reader_{session_->Tasks()};
  TaskRunner copier_{session_->Tasks(), TaskPolicy::kQueue};
  TaskRunner watcher_;  ///< of its own: nobody waits for it
  QString path_;
  QString interrupted_;
  QString wanted_;      ///< to be recorded into as soon as it is free; empty = none
  bool moved_ = false;  ///< the file is no longer where it was opened
  std::string author_;
  std::shared_ptr<MissionFile> file_;
  /// Those that were recorded into before: what belongs to their scans is still written there.
  std::vector<std::shared_ptr<MissionFile>> earlier_files_;
  std::shared_ptr<MissionFile> list_file_;  ///< a connection of its own, for reading beside
  std::shared_ptr<ScanRecorder> recorder_;
  std::vector<ScanSummary> scans_;
  std::deque<Change> waiting_;
  bool failed_ = false;  ///< the last write failed; what waits is tried again when asked
};

}  // namespace foresight
