#include "ui/viewmodels/review_view_model.h"

#include <algorithm>

#include "core/mission/side_result.h"
#include "ui/viewmodels/mission_objects.h"

namespace foresight {
struct ReviewViewModel::Wanted {
  std::vector<std::string> paths;      ///< to be opened; the last one is shown
  std::shared_ptr<MissionFile> file;   ///< or one that is open is shown
  std::string scan_uuid, object_uuid;  ///< empty = its last scan, any object
};

struct ReviewViewModel::Opened {
  std::vector<OpenMission> missions;  ///< the last one is shown
  std::vector<Error> failed;
  int index = -1;
  ReviewedScan scan;
  std::string object_uuid;
  std::vector<NoteRecord> notes;  ///< of the mission that is shown
};

ReviewViewModel::ReviewViewModel(SessionModel* review, QObject* parent)
    : QObject(parent), session_(review) {
  connect(&loader_, &TaskRunner::changed, this, &ReviewViewModel::changed);
  connect(session_, &SessionModel::objectAdded, this, [this](const FoundObject& object) {
    known_[object.uuid] = object;
    Write([object](MissionFile* notes) { return KeepObject(notes, object, OperatorName()); },
          object.uuid);
  });
  connect(session_->Notes(), &NotesModel::touched, this, [this](const NoteRecord& note) {
    Write([note](MissionFile* notes) { return KeepNote(notes, note); }, {});
  });
  connect(session_->Notes(), &NotesModel::scanWanted, this, &ReviewViewModel::showScanWith);
  connect(session_, &SessionModel::objectTouched, this, [this](const ObjectEvent& event) {
    const auto object = known_.find(event.uuid);
    if (object == known_.end()) return;
    // An object of the mission itself is copied into the notes first: the mission is not touched.
    Write(
        [event, object = object->second](MissionFile* notes) -> Status {
          FORESIGHT_CHECK(KeepObject(notes, object, OperatorName()));
          return KeepObjectEvent(notes, event, OperatorName());
        },
        {});
  });
}

QString ReviewViewModel::Path() const {
  return mission_index_ < 0 ? QString()
                            : missions_[static_cast<std::size_t>(mission_index_)].Path();
}

std::shared_ptr<MissionFile> ReviewViewModel::File() const {
  return mission_index_ < 0 ? nullptr : missions_[static_cast<std::size_t>(mission_index_)].file;
}

const std::vector<ScanSummary>& ReviewViewModel::Scans() const {
  static const std::vector<ScanSummary> kNone;
  return mission_index_ < 0 ? kNone : missions_[static_cast<std::size_t>(mission_index_)].scans;
}

void ReviewViewModel::Open(const QString& path, const std::string& scan_uuid,
                           const std::string& object_uuid) {
  const int open = MissionAt(path.toStdString());
  Wanted wanted{{}, nullptr, scan_uuid, object_uuid};
  if (open < 0)
    wanted.paths = {path.toStdString()};
  else
    wanted.file = missions_[static_cast<std::size_t>(open)].file;
  Load(tr("Opening the mission"), std::move(wanted));
}

void ReviewViewModel::OpenAll(const QStringList& paths) {
  if (paths.size() == 1) return Open(paths.front());
  Wanted wanted;
  for (const QString& path : paths)
    if (MissionAt(path.toStdString()) < 0) wanted.paths.push_back(path.toStdString());
  if (!wanted.paths.empty())
    Load(tr("Opening the missions"), std::move(wanted));
  else if (!paths.isEmpty())
    Open(paths.back());
}

void ReviewViewModel::showScanWith(const QString& uuid) {
  for (std::size_t i = 0; i < Scans().size(); ++i)
    if (Scans()[i].uuid == uuid.toStdString() && static_cast<int>(i) != scan_index_)
      return showScan(static_cast<int>(i));
}

void ReviewViewModel::showScan(int index) {
  ShowScanOf(mission_index_, index);
}

void ReviewViewModel::ShowScanOf(int mission, int scan) {
  if (mission < 0 || mission >= static_cast<int>(missions_.size())) return;
  const OpenMission& wanted = missions_[static_cast<std::size_t>(mission)];
  if (scan < 0 || scan >= static_cast<int>(wanted.scans.size())) return;
  Load(tr("Loading the scan"),
       {{}, wanted.file, wanted.scans[static_cast<std::size_t>(scan)].uuid, {}});
}

int ReviewViewModel::MissionAt(const std::filesystem::path& path) const {
  std::error_code error;
  for (std::size_t i = 0; i < missions_.size(); ++i)
    if (missions_[i].file->path() == path ||
        std::filesystem::equivalent(missions_[i].file->path(), path, error))
      return static_cast<int>(i);
  return -1;
}

Result<ReviewViewModel::Opened> ReviewViewModel::LoadWanted(const Wanted& wanted,
                                                            const RunContext& context) {
  context.Report(0.1, "reading");
  Opened opened;
  opened.object_uuid = wanted.object_uuid;
  const auto take = [&](std::shared_ptr<MissionFile> file) -> Status {
    FORESIGHT_TRY(std::vector<ScanSummary> scans, file->ListScans());
    if (scans.empty())
      return Fail(ErrorCode::kBadData, "{}: the mission holds no scan", file->path().string());
    opened.missions.push_back({std::move(file), std::move(scans)});
    return {};
  };
  if (wanted.file) FORESIGHT_CHECK(take(wanted.file));
  for (const std::string& path : wanted.paths) {
    auto file = MissionFile::OpenReadOnly(path);
    const Status taken = file ? take(std::move(*file)) : Status(tl::make_unexpected(file.error()));
    if (!taken) opened.failed.push_back(taken.error());
  }
  if (opened.missions.empty()) return opened;
  const OpenMission& shown = opened.missions.back();
  opened.index = static_cast<int>(shown.scans.size()) - 1;
  for (std::size_t i = 0; i < shown.scans.size(); ++i)
    if (shown.scans[i].uuid == wanted.scan_uuid) opened.index = static_cast<int>(i);
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(shown.file->path(), ReviewFolder()));
  FORESIGHT_TRY(opened.notes, NotesOfMission(*shown.file, review.get()));
  FORESIGHT_TRY(opened.scan, LoadReviewedScan(*shown.file, ReviewFolder(),
                                              shown.scans[static_cast<std::size_t>(opened.index)]));
  return opened;
}

void ReviewViewModel::Load(const QString& title, Wanted wanted) {
  loader_.Run<Opened>(
      title,
      [wanted = std::move(wanted)](const RunContext& context) {
        return LoadWanted(wanted, context);
      },
      [this, title](Result<Opened> opened) {
        if (!opened) {
          session_->Report(NoticeOf(title, opened.error()));
          return Q_EMIT notOpened();
        }
        for (const Error& error : opened->failed) session_->Report(NoticeOf(title, error));
        if (opened->missions.empty()) return Q_EMIT notOpened();
        Show(std::move(*opened));
      });
}

void ReviewViewModel::List(OpenMission mission) {
  const int known = MissionAt(mission.file->path());
  if (known < 0)
    missions_.push_back(std::move(mission));
  else
    missions_[static_cast<std::size_t>(known)].scans = std::move(mission.scans);
}

void ReviewViewModel::Show(Opened loaded) {
  const std::filesystem::path shown = loaded.missions.back().file->path();
  for (OpenMission& mission : loaded.missions) List(std::move(mission));
  mission_index_ = MissionAt(shown);
  std::vector<FoundObject> objects = loaded.scan.Objects();
  session_->ShowObjects({});
  session_->SetScan(std::move(loaded.scan.scan));
  session_->ShowObjects(objects);
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (objects[i].uuid == loaded.object_uuid) session_->SelectObject(static_cast<int>(i));
  session_->Notes()->Show(loaded.notes);
  Follow(loaded.index, objects);
  Q_EMIT opened();
}

void ReviewViewModel::Follow(int scan, const std::vector<FoundObject>& objects) {
  scan_index_ = scan;
  known_.clear();
  for (const FoundObject& object : objects) known_[object.uuid] = object;
  Q_EMIT changed();
}

void ReviewViewModel::close() {
  CloseMission(mission_index_);
}

void ReviewViewModel::CloseMission(int index) {
  if (index < 0 || index >= static_cast<int>(missions_.size())) return;
  loader_.cancel();
  missions_.erase(missions_.begin() + index);
  const bool shown = index == mission_index_;
  if (index < mission_index_) --mission_index_;
  if (shown) {
    mission_index_ = scan_index_ = -1;
    known_.clear();
    session_->ShowObjects({});
    session_->Notes()->Show({});
    session_->SetScan(nullptr);
  }
  Q_EMIT changed();
  if (!shown || missions_.empty()) return;
  const int next = std::max(0, index - 1);
  ShowScanOf(next, static_cast<int>(missions_[static_cast<std::size_t>(next)].scans.size()) - 1);
}

void ReviewViewModel::CopyTo(const QString& path) {
  const auto file = File();
  if (!file) return;
  copier_.Run<bool>(
      tr("Copying the mission"),
      [file, path = path.toStdString()](const RunContext&) -> Result<bool> {
        FORESIGHT_CHECK(file->ExportTo(path));
        return true;
      },
      [this, path](const Result<bool>& copied) {
        session_->Report(copied ? Notice{Notice::Level::kInfo,
                                         tr("Copied the mission under review to %1.").arg(path),
                                         {}}
                                : NoticeOf(tr("Copying the mission"), copied.error()));
      });
}

void ReviewViewModel::Write(std::function<Status(MissionFile*)> body,
                            const std::string& object_uuid) {
  Keep(std::move(body), [this, object_uuid](const Status& kept) {
    if (!kept) return session_->Report(NoticeOf(tr("Keeping the review"), kept.error()));
    if (!object_uuid.empty()) session_->MarkKept(object_uuid);
  });
}

void ReviewViewModel::Keep(std::function<Status(MissionFile*)> body,
                           std::function<void(const Status&)> kept) {
  if (const auto file = File()) KeepIn(file->path(), std::move(body), std::move(kept));
}

void ReviewViewModel::KeepIn(const std::filesystem::path& mission,
                             std::function<Status(MissionFile*)> body,
                             std::function<void(const Status&)> kept) {
  writer_.Run<bool>(
      tr("Keeping the review"),
      [mission, folder = ReviewFolder(),
       body = std::move(body)](const RunContext&) -> Result<bool> {
        FORESIGHT_TRY(const auto notes, MissionFile::OpenReviewOf(mission, folder));
        FORESIGHT_CHECK(body(notes.get()));
        FORESIGHT_CHECK(notes->Close());
        return true;
      },
      [this, kept = std::move(kept)](const Result<bool>& written) {
        kept(written ? Status() : tl::unexpected(written.error()));
        if (written) Q_EMIT reviewKept();
      });
}

}  // namespace foresight
