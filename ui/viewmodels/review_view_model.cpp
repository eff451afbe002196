#include "ui/viewmodels/review_view_model.h"

#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/recording_view_model.h"

namespace foresight {
namespace {

/// What was found in a scan of a mission in earlier reviews.
Result<std::vector<DetectionRecord>> ReviewedDetections(const std::filesystem::path& mission,
                                                        const std::filesystem::path& folder,
                                                        const std::string& scan_uuid) {
  std::vector<DetectionRecord> records;
  const auto path = MissionFile::ReviewPathOf(mission, folder);
  std::error_code error;
  if (!path || !std::filesystem::exists(*path, error)) return records;  // no review yet
  FORESIGHT_TRY(const auto notes, MissionFile::OpenReadOnly(*path));
  FORESIGHT_TRY(records, notes->ListDetections());
  std::erase_if(records,
                [&](const DetectionRecord& record) { return record.scan_uuid != scan_uuid; });
  return records;
}

/// The objects of a scan out of the mission and out of the file with its review.
Result<std::vector<FoundObject>> ObjectsOf(const MissionFile& mission,
                                           const std::filesystem::path& folder,
                                           const ScanSummary& summary, const Scan& scan) {
  FORESIGHT_TRY(std::vector<DetectionRecord> records, mission.ListDetections(summary.id));
  FORESIGHT_TRY(const std::vector<DetectionRecord> reviewed,
                ReviewedDetections(mission.path(), folder, scan.uuid));
  for (const DetectionRecord& record : reviewed) {
    // What was decided in a review counts more than what the mission says of the same object.
    std::erase_if(records, [&](const DetectionRecord& other) { return other.uuid == record.uuid; });
    records.push_back(record);
  }
  std::vector<FoundObject> objects;
  for (const DetectionRecord& record : records) {
    if (record.deleted) continue;
    FORESIGHT_TRY(FoundObject object, ObjectOf(record, scan.rig, BeginUtc_ns(scan)));
    object.scan_uuid = scan.uuid;
    objects.push_back(std::move(object));
  }
  return objects;
}

/// Of the mission and of its review, which counts more.
Result<std::vector<NoteRecord>> NotesOf(const MissionFile& mission,
                                        const std::filesystem::path& folder) {
  FORESIGHT_TRY(std::vector<NoteRecord> notes, mission.ListNotes());
  const auto path = MissionFile::ReviewPathOf(mission.path(), folder);
  std::error_code error;
  if (!path || !std::filesystem::exists(*path, error)) return notes;  // no review yet
  FORESIGHT_TRY(const auto review, MissionFile::OpenReadOnly(*path));
  FORESIGHT_TRY(const std::vector<NoteRecord> later, review->ListNotes());
  notes.insert(notes.end(), later.begin(), later.end());
  return CurrentNotes(notes);
}

/// Where notes go that cannot lie beside their mission.
std::filesystem::path NotesFolder() {
  return RecordingViewModel::DefaultFolder().toStdString();
}

}  // namespace

struct ReviewViewModel::Opened {
  std::shared_ptr<MissionFile> file;
  std::vector<ScanSummary> scans;
  int index = -1;
  std::shared_ptr<const Scan> scan;
  std::vector<FoundObject> objects;
  std::vector<NoteRecord> notes;
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

void ReviewViewModel::showScanWith(const QString& uuid) {
  for (std::size_t i = 0; i < scans_.size(); ++i)
    if (scans_[i].uuid == uuid.toStdString() && static_cast<int>(i) != scan_index_)
      showScan(static_cast<int>(i));
}

QString ReviewViewModel::Path() const {
  return file_ ? QString::fromStdString(file_->path().string()) : QString();
}

void ReviewViewModel::Open(const QString& path, const std::string& scan_uuid) {
  Load(tr("Opening the mission"), nullptr, path.toStdString(), scan_uuid);
}

void ReviewViewModel::showScan(int index) {
  if (!file_ || index < 0 || index >= static_cast<int>(scans_.size())) return;
  Load(tr("Loading the scan"), file_, file_->path().string(),
       scans_[static_cast<std::size_t>(index)].uuid);
}

void ReviewViewModel::Load(const QString& title, std::shared_ptr<MissionFile> file,
                           const std::string& path, const std::string& scan_uuid) {
  const auto work = [file = std::move(file), path, scan_uuid,
                     folder = NotesFolder()](const RunContext& context) -> Result<Opened> {
    context.Report(0.1, "reading");
    Opened opened;
    opened.file = file;
    if (!opened.file) {
      FORESIGHT_TRY(opened.file, MissionFile::OpenReadOnly(path));
    }
    FORESIGHT_TRY(opened.scans, opened.file->ListScans());
    if (opened.scans.empty())
      return Fail(ErrorCode::kBadData, "{}: the mission holds no scan", path);
    opened.index = static_cast<int>(opened.scans.size()) - 1;
    for (std::size_t i = 0; i < opened.scans.size(); ++i)
      if (opened.scans[i].uuid == scan_uuid) opened.index = static_cast<int>(i);
    const ScanSummary& summary = opened.scans[static_cast<std::size_t>(opened.index)];
    FORESIGHT_TRY(Scan scan, opened.file->LoadScan(summary.id));
    FORESIGHT_TRY(opened.objects, ObjectsOf(*opened.file, folder, summary, scan));
    FORESIGHT_TRY(opened.notes, NotesOf(*opened.file, folder));
    opened.scan = std::make_shared<const Scan>(std::move(scan));
    return opened;
  };
  loader_.Run<Opened>(title, work, [this, title](Result<Opened> opened) {
    if (opened)
      Show(std::move(*opened));
    else
      session_->Report(NoticeOf(title, opened.error()));
  });
}

void ReviewViewModel::Show(Opened loaded) {
  file_ = std::move(loaded.file);
  scans_ = std::move(loaded.scans);
  scan_index_ = loaded.index;
  session_->ShowObjects({});
  session_->SetScan(std::move(loaded.scan));
  known_.clear();
  for (const FoundObject& object : loaded.objects) known_[object.uuid] = object;
  session_->ShowObjects(std::move(loaded.objects));
  session_->Notes()->Show(loaded.notes);
  Q_EMIT opened();
  Q_EMIT changed();
}

void ReviewViewModel::close() {
  loader_.cancel();
  file_.reset();
  scans_.clear();
  scan_index_ = -1;
  session_->ShowObjects({});
  session_->Notes()->Show({});
  session_->SetScan(nullptr);
  Q_EMIT changed();
}

void ReviewViewModel::CopyTo(const QString& path) {
  if (!file_) return;
  copier_.Run<bool>(
      tr("Copying the mission"),
      [file = file_, path = path.toStdString()](const RunContext&) -> Result<bool> {
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
  if (!file_) return;
  writer_.Run<bool>(
      tr("Keeping the review"),
      [mission = file_->path(), folder = NotesFolder(),
       body = std::move(body)](const RunContext&) -> Result<bool> {
        FORESIGHT_TRY(const auto notes, MissionFile::OpenReviewOf(mission, folder));
        FORESIGHT_CHECK(body(notes.get()));
        FORESIGHT_CHECK(notes->Close());
        return true;
      },
      [this, object_uuid](const Result<bool>& kept) {
        if (!kept)
          session_->Report(NoticeOf(tr("Keeping the review"), kept.error()));
        else if (!object_uuid.empty())
          session_->MarkKept(object_uuid);
      });
}

}  // namespace foresight
