#include "ui/viewmodels/recording_view_model.h"

#include <QCoreApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QFileInfo>
#include <QStandardPaths>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "core/base/utc_text.h"
#include "core/mission/mission_timeline.h"
#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/no_scan_hint.h"

namespace foresight {
namespace {

const QString kSuffix = QStringLiteral("foresight");
constexpr int kLookAfter_ms = 2000;  ///< whether the file is where it was, or free
constexpr int kOfferAgain_ms[] = {2000, 5000, 10000};

QString FreePath(const QString& folder) {
  const QString base = QDir(folder).filePath(
      QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd_HH-mm-ss")));
  QString path = base + QLatin1Char('.') + kSuffix;
  for (int i = 2; QFileInfo::exists(path); ++i)
    path = QStringLiteral("%1_%2.%3").arg(base).arg(i).arg(kSuffix);
  return path;
}

bool IsSameFile(const QString& a, const QString& b) {
  return QFileInfo(a).absoluteFilePath() == QFileInfo(b).absoluteFilePath();
}

/// Whether a program ended without closing the file.
bool WasLeftBehind(const QString& path) {
  // Closing a file takes its write-ahead log away.
  if (!QFileInfo::exists(path + QStringLiteral("-wal"))) return false;
  const auto mission = MissionFile::OpenReadOnly(path.toStdString());
  return mission && !(*mission)->IsBeingRecorded();
}

bool IsBeingRecorded(const QString& path) {
  const auto mission = MissionFile::OpenReadOnly(path.toStdString());
  return mission && (*mission)->IsBeingRecorded();
}

EarlierContents ContentsOf(const MissionFile& file) {
  EarlierContents contents;
  if (const auto scans = file.ListScans(); scans && !scans->empty()) {
    contents.scans = static_cast<int>(scans->size());
    if (scans->back().state == ScanState::kInterrupted)
      contents.interrupted = QDateTime::fromMSecsSinceEpoch(scans->back().begin_utc_ns / 1'000'000);
  }
  const auto are_there = [](const auto& records) {
    return static_cast<int>(std::count_if(records.begin(), records.end(),
                                          [](const auto& record) { return !record.deleted; }));
  };
  if (const auto objects = file.ListDetections()) contents.objects = are_there(*objects);
  if (const auto notes = file.ListNotes()) contents.notes = are_there(*notes);
  return contents;
}

/// Whether the file holds nothing that anybody would miss.
bool IsEmpty(const MissionFile& file) {
  const auto scans = file.ListScans();
  const auto objects = file.ListDetections();
  const auto notes = file.ListNotes();
  return scans && scans->empty() && objects && objects->empty() && notes && notes->empty();
}

/// Writes into the newest file that knows the scan or the object; kInvalidInput = none does.
Status InTheFileThatKnowsIt(const std::vector<std::shared_ptr<MissionFile>>& files,
                            const std::function<Status(MissionFile*)>& write) {
  Status status;
  for (const auto& file : files) {
    status = write(file.get());
    if (status || status.error().code != ErrorCode::kInvalidInput) return status;
  }
  return status;
}

const char* SeverityOf(Notice::Level level) {
  switch (level) {
    case Notice::Level::kInfo:
      return "info";
    case Notice::Level::kWarning:
      return "warning";
    case Notice::Level::kError:
      break;
  }
  return "error";
}

}  // namespace

RecordingViewModel::RecordingViewModel(SessionModel* live, QObject* parent)
    : QObject(parent), session_(live), author_(OperatorName()) {
  connect(session_, &SessionModel::objectAdded, this, &RecordingViewModel::keepObject);
  connect(session_, &SessionModel::objectTouched, this, &RecordingViewModel::keepObjectEvent);
  connect(session_->Notes(), &NotesModel::touched, this, &RecordingViewModel::keepNote);
  for (TaskRunner* runner : {&writer_, &reader_, &copier_})
    connect(runner, &TaskRunner::changed, this, &RecordingViewModel::changed);
  auto* look_after = new QTimer(this);
  connect(look_after, &QTimer::timeout, this, &RecordingViewModel::LookAfterFile);
  look_after->start(kLookAfter_ms);
}

RecordingViewModel::~RecordingViewModel() {
  recorder_.reset();
  if (!file_) return;
  list_file_.reset();
  const bool empty = IsEmpty(*file_) && !file_->HasMoved();
  if (const Status closed = file_->Close(); closed && empty) QFile::remove(path_);
}

QString RecordingViewModel::DefaultFolder() {
  const QString folder = QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation))
                             .filePath(QStringLiteral("missions"));
  QDir().mkpath(folder);
  return folder;
}

QStringList RecordingViewModel::LeftBehind(const QString& folder) {
  QStringList paths;
  const auto files =
      QDir(folder).entryInfoList({QStringLiteral("*.") + kSuffix}, QDir::Files, QDir::Time);
  for (const QFileInfo& file : files)
    if (WasLeftBehind(file.filePath())) paths << file.filePath();
  return paths;
}

void RecordingViewModel::OfferInterrupted(const QString& folder, const QString& last_path) {
  if (Offer(folder, last_path)) return;
  for (const int later_ms : kOfferAgain_ms)
    QTimer::singleShot(later_ms, this, [this, folder, last_path] {
      if (interrupted_.isEmpty()) Offer(folder, last_path);
    });
}

bool RecordingViewModel::Offer(const QString& folder, const QString& last_path) {
  QStringList left = LeftBehind(folder);
  if (!last_path.isEmpty() && WasLeftBehind(last_path)) left.prepend(last_path);
  if (left.isEmpty()) return false;
  interrupted_ = left.first();
  session_->Report({Notice::Level::kWarning,
                    tr("The program ended unexpectedly the last time; its mission was kept: %1.")
                        .arg(interrupted_),
                    tr("Go on recording in it, or look at it with Open for review (Ctrl+O)."),
                    kInterruptedTopic, QStringLiteral("recording.continue")});
  Q_EMIT changed();
  return true;
}

void RecordingViewModel::continueInterrupted() {
  if (!interrupted_.isEmpty()) SwitchTo(interrupted_);
}

Status RecordingViewModel::Open(const QString& path, std::shared_ptr<MissionFile>* file) const {
  const std::string name = path.toStdString();
  if (QFileInfo::exists(path)) {
    FORESIGHT_TRY(*file, MissionFile::Open(name));
  } else {
    FORESIGHT_TRY(*file, MissionFile::Create(name));
  }
  return {};
}

int RecordingViewModel::Waiting() const {
  return static_cast<int>(std::count_if(waiting_.begin(), waiting_.end(), [](const Change& change) {
    return !std::holds_alternative<EventRecord>(change) &&
           !std::holds_alternative<MadeDepth>(change);
  }));
}

bool RecordingViewModel::Begin(const QString& path) {
  const bool left_behind = WasLeftBehind(path);
  std::shared_ptr<MissionFile> file;
  if (const Status opened = Open(path, &file); !opened) {
    Notice notice = NoticeOf(tr("Recording into %1").arg(path), opened.error());
    notice.next = tr("Nothing is recorded now. Choose another file (Ctrl+Shift+S).");
    if (IsBeingRecorded(path)) {
      notice.next =
          tr("Nothing is recorded until that program ends, or you choose another file "
             "(Ctrl+Shift+S).");
      wanted_ = path;
    }
    notice.topic = kRecordingTopic;
    session_->Report(notice);
    return false;
  }
  path_ = path;
  const EarlierContents earlier = ContentsOf(*file);
  Use(std::move(file), earlier);
  if (left_behind) {
    const QString held = EarlierText(earlier);
    session_->Report({Notice::Level::kWarning,
                      tr("The program ended unexpectedly the last time. Recording goes on in the "
                         "same mission."),
                      held.isEmpty() ? tr("It was empty.")
                                     : (tr("It holds %1 from before the restart. ").arg(held) +
                                        InterruptedText(earlier))
                                           .trimmed()});
  }
  return true;
}

void RecordingViewModel::LookAfterFile() {
  if (watcher_.Busy() || (!file_ && wanted_.isEmpty())) return;
  if (file_) {
    watcher_.Run<bool>(
        tr("Looking after the mission file"),
        [file = file_](const RunContext&) -> Result<bool> { return file->HasMoved(); },
        [this, file = file_](const Result<bool>& moved) {
          if (moved && file == file_) TellWhetherItMoved(*moved);
        });
    return;
  }
  watcher_.Run<bool>(
      tr("Looking after the mission file"),
      [path = wanted_](const RunContext&) -> Result<bool> { return IsBeingRecorded(path); },
      [this](const Result<bool>& in_use) {
        // Another file may have been chosen meanwhile.
        if (!in_use || *in_use || file_ || wanted_.isEmpty() || writer_.Busy()) return;
        if (Begin(std::exchange(wanted_, {})) && waiting_.empty()) Q_EMIT allWritten();
      });
}

void RecordingViewModel::TellWhetherItMoved(bool moved) {
  if (moved == moved_) return;
  moved_ = moved;
  Q_EMIT changed();
  if (!moved) {  // somebody brought it back
    tryAgain();
    if (waiting_.empty()) Q_EMIT allWritten();
    return;
  }
  session_->Report(
      {Notice::Level::kError,
       tr("The mission file %1 was moved or deleted while it was being recorded into.").arg(path_),
       tr("Record into a new file (Ctrl+Shift+S): it begins with everything recorded so far."),
       kRecordingTopic});
}

bool RecordingViewModel::BeginInFolder(const QString& folder) {
  return Begin(FreePath(folder));
}

void RecordingViewModel::SwitchTo(const QString& path) {
  // What was recorded into before in this sitting is still open: a file has one writer.
  const auto earlier =
      std::find_if(earlier_files_.begin(), earlier_files_.end(), [&](const auto& file) {
        return IsSameFile(QString::fromStdString(file->path().string()), path) && !file->HasMoved();
      });
  const auto open_already = file_ && IsSameFile(path_, path)  ? file_
                            : earlier != earlier_files_.end() ? *earlier
                                                              : nullptr;
  struct Opened {
    std::shared_ptr<MissionFile> file;
    EarlierContents earlier;
    bool holds_all = false;  ///< of the file before
  };
  writer_.Run<Opened>(
      tr("Opening the mission file"),
      [this, path, open_already, old = file_](const RunContext&) -> Result<Opened> {
        std::shared_ptr<MissionFile> file = open_already;
        const bool moved = old && old->HasMoved();
        if (moved) {
          // Its own name, too: what SQLite kept beside the file still lies there.
          if (QFileInfo::exists(path) ||
              IsSameFile(QString::fromStdString(old->path().string()), path))
            return Fail(ErrorCode::kInvalidInput,
                        "{}: the file before was moved or deleted; choose a new name, which begins "
                        "with everything recorded so far",
                        path.toStdString());
          FORESIGHT_CHECK(old->ExportTo(path.toStdString()));
        }
        if (!file) FORESIGHT_CHECK(Open(path, &file));
        return Opened{file, ContentsOf(*file), moved};
      },
      [this, path](Result<Opened> opened) {
        if (!opened) {
          Notice notice = NoticeOf(tr("Opening the mission file"), opened.error());
          notice.topic = kRecordingTopic;
          session_->Report(notice);
          return;
        }
        std::erase(earlier_files_, opened->file);
        const auto old = file_ == opened->file ? nullptr : file_;
        const QString old_path = path_;
        recorder_.reset();
        list_file_.reset();
        path_ = path;
        Use(std::move(opened->file), opened->earlier);
        session_->Report({Notice::Level::kInfo, tr("Recording goes on in %1.").arg(path), {}});
        if (!old || opened->holds_all) return;
        if (!old->HasMoved() && IsEmpty(*old) && old->Close())
          QFile::remove(old_path);
        else
          earlier_files_.insert(earlier_files_.begin(), old);  // decisions on its objects go there
      });
}

void RecordingViewModel::Use(std::shared_ptr<MissionFile> file, const EarlierContents& earlier) {
  file_ = std::move(file);
  session_->SetEarlier(earlier);
  recorder_ = std::make_shared<ScanRecorder>(file_);
  failed_ = moved_ = false;
  wanted_.clear();
  if (!interrupted_.isEmpty() && IsSameFile(path_, interrupted_)) {
    interrupted_.clear();
    Q_EMIT interruptedTaken();
  }
  scans_.clear();
  refreshList();
  WriteNext();
  Q_EMIT changed();
}

void RecordingViewModel::refreshList() {
  if (!file_) return;
  struct Listed {
    std::shared_ptr<MissionFile> file;
    std::vector<ScanSummary> scans;
  };
  reader_.Run<Listed>(
      tr("Listing the scans"),
      [file = list_file_, path = path_.toStdString()](const RunContext&) -> Result<Listed> {
        Listed listed{file, {}};
        if (!listed.file) {
          FORESIGHT_TRY(listed.file, MissionFile::OpenReadOnly(path));
        }
        FORESIGHT_TRY(listed.scans, listed.file->ListScans());
        return listed;
      },
      [this](Result<Listed> listed) {
        if (!listed) return;  // the file itself is not in danger; the next change lists again
        list_file_ = listed->file;
        scans_ = std::move(listed->scans);
        Q_EMIT changed();
      });
}

void RecordingViewModel::CopyTo(const QString& path) {
  if (!file_) {
    session_->Report({Notice::Level::kWarning, tr("There is no mission file to copy."),
                      tr("Choose a file to record into first (Ctrl+Shift+S).")});
    return;
  }
  copier_.Run<bool>(
      tr("Copying the mission"),
      [file = file_, path = path.toStdString()](const RunContext&) -> Result<bool> {
        FORESIGHT_CHECK(file->ExportTo(path));
        return true;
      },
      [this, path](const Result<bool>& copied) {
        session_->Report(
            copied
                ? Notice{Notice::Level::kInfo,
                         tr("Copied the mission to %1; recording goes on in %2.").arg(path, path_),
                         {}}
                : NoticeOf(tr("Copying the mission"), copied.error()));
      });
}

bool RecordingViewModel::WriteAll(int limit_ms) {
  QElapsedTimer timer;
  timer.start();
  while (file_ && !failed_ && !waiting_.empty() && timer.elapsed() < limit_ms)
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents | QEventLoop::AllEvents, 20);
  return waiting_.empty();
}

void RecordingViewModel::tryAgain() {
  failed_ = false;
  WriteNext();
}

void RecordingViewModel::keepScan(const std::shared_ptr<const Scan>& scan) {
  Keep(scan);
}

void RecordingViewModel::keepObject(const FoundObject& object) {
  Keep(object);
}

void RecordingViewModel::keepObjectEvent(const ObjectEvent& event) {
  Keep(event);
}

void RecordingViewModel::keepDepth() {
  if (session_->CurrentScan() && session_->Depth())
    Keep(MadeDepth{session_->CurrentScan(), session_->Depth()});
}

void RecordingViewModel::keepNote(const NoteRecord& note) {
  Keep(note);
}

void RecordingViewModel::keepCheck(const KeptCheck& check) {
  Keep(check);
}

void RecordingViewModel::keepNotice(const Notice& notice) {
  if (notice.topic == kRecordingTopic) return;  // it could not be written
  Keep(EventRecord{0,
                   NowUtc_ns(),
                   "workstation",
                   SeverityOf(notice.level),
                   (notice.what + QLatin1Char(' ') + notice.next).trimmed().toStdString(),
                   {}});
}

void RecordingViewModel::keepCommand(const QString& id) {
  Keep(EventRecord{0, NowUtc_ns(), author_, "info", "command " + id.toStdString(), {}});
}

void RecordingViewModel::keepLink(bool connected) {
  Keep(EventRecord{0,
                   NowUtc_ns(),
                   kLinkEventSource,
                   connected ? "info" : "warning",
                   connected ? kLinkUpText : kLinkLostText,
                   {}});
}

void RecordingViewModel::Keep(Change change) {
  waiting_.push_back(std::move(change));
  failed_ = false;  // there may be room again
  WriteNext();
  Q_EMIT changed();
}

void RecordingViewModel::WriteNext() {
  if (!file_ || failed_ || writer_.Busy() || waiting_.empty()) return;
  std::vector<std::shared_ptr<MissionFile>> files = earlier_files_;
  files.insert(files.begin(), file_);
  const auto work = [file = file_, files, recorder = recorder_, author = author_,
                     change = waiting_.front()](const RunContext& context) -> Result<bool> {
    if (file->HasMoved())
      return Fail(ErrorCode::kIo, "{}: was moved or deleted", file->path().string());
    if (const auto* scan = std::get_if<std::shared_ptr<const Scan>>(&change)) {
      // What the recorder could not write is appended; if it still cannot be, that is said.
      (void)recorder->WaitUntilWritten();
      FORESIGHT_CHECK(AppendScan(file.get(), **scan, context));
    } else if (const auto* object = std::get_if<FoundObject>(&change)) {
      // Found while its scan comes: the scan is in the file when its first lines are.
      if (object->part) (void)recorder->WaitUntilWritten();
      FORESIGHT_CHECK(InTheFileThatKnowsIt(
          files, [&](MissionFile* one) { return KeepObject(one, *object, author); }));
    } else if (const auto* event = std::get_if<ObjectEvent>(&change)) {
      FORESIGHT_CHECK(InTheFileThatKnowsIt(
          files, [&](MissionFile* one) { return KeepObjectEvent(one, *event, author); }));
    } else if (const auto* made = std::get_if<MadeDepth>(&change)) {
      FORESIGHT_CHECK(InTheFileThatKnowsIt(
          files, [&](MissionFile* one) { return KeepDepth(one, *made->scan, *made->depth); }));
    } else if (const auto* note = std::get_if<NoteRecord>(&change)) {
      // Its scan may still be coming: it is in the file when its first lines are.
      if (!note->scan_uuid.empty()) (void)recorder->WaitUntilWritten();
      FORESIGHT_CHECK(
          InTheFileThatKnowsIt(files, [&](MissionFile* one) { return KeepNote(one, *note); }));
    } else if (const auto* check = std::get_if<KeptCheck>(&change)) {
      FORESIGHT_CHECK(
          InTheFileThatKnowsIt(files, [&](MissionFile* one) { return KeepCheck(one, *check); }));
    } else {
      FORESIGHT_CHECK(file->AddEvent(std::get<EventRecord>(change)));
    }
    return true;
  };
  writer_.Run<bool>(tr("Writing the mission file"), work, [this](const Result<bool>& written) {
    if (!written && written.error().code == ErrorCode::kInvalidInput) {
      waiting_.pop_front();  // no file will ever take it
      session_->Report(NoticeOf(tr("Writing the mission file"), written.error()));
      WriteNext();
      return;
    }
    if (!written) {
      failed_ = true;
      if (file_->HasMoved()) {
        moved_ = false;  // said again: there is more to lose
        TellWhetherItMoved(true);
        return;
      }
      Notice notice = NoticeOf(tr("Writing the mission file"), written.error());
      notice.next =
          tr("It stays in memory until the file can be written again, or you record "
             "into another one (Ctrl+Shift+S).");
      notice.topic = kRecordingTopic;
      session_->Report(notice);
      return;
    }
    const Change done = std::move(waiting_.front());
    waiting_.pop_front();
    if (const auto* object = std::get_if<FoundObject>(&done)) session_->MarkKept(object->uuid);
    if (!std::holds_alternative<EventRecord>(done) && !std::holds_alternative<MadeDepth>(done))
      refreshList();
    if (waiting_.empty()) Q_EMIT allWritten();
    WriteNext();
  });
}

}  // namespace foresight
