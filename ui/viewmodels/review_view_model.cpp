#include "ui/viewmodels/review_view_model.h"

#include "core/mission/side_result.h"
#include "ui/viewmodels/mission_objects.h"
#include "ui/viewmodels/recording_view_model.h"

namespace foresight {
namespace {

/// The objects of a scan out of the mission and out of the file with its review.
Result<std::vector<FoundObject>> ObjectsOf(const MissionFile& mission,
                                           const std::filesystem::path& folder, const Scan& scan) {
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(mission.path(), folder));
  FORESIGHT_TRY(const std::vector<DetectionRecord> records,
                DetectionsOfScan(mission, review.get(), scan.uuid));
  std::vector<FoundObject> objects;
  for (const DetectionRecord& record : records) {
    if (record.deleted) continue;
    FORESIGHT_TRY(FoundObject object, ObjectOf(record, scan.rig, BeginUtc_ns(scan)));
    object.scan_uuid = scan.uuid;
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace

struct ReviewViewModel::Opened {
  std::shared_ptr<MissionFile> file;
  std::vector<ScanSummary> scans;
  int index = -1;
  std::shared_ptr<const Scan> scan;
  std::vector<FoundObject> objects;
};

ReviewViewModel::ReviewViewModel(SessionModel* review, QObject* parent)
    : QObject(parent), session_(review) {
  connect(&loader_, &TaskRunner::changed, this, &ReviewViewModel::changed);
  connect(session_, &SessionModel::objectAdded, this, [this](const FoundObject& object) {
    known_[object.uuid] = object;
    Write([object](MissionFile* notes) { return KeepObject(notes, object, OperatorName()); },
          object.uuid);
  });
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
                     folder = ReviewFolder()](const RunContext& context) -> Result<Opened> {
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
    FORESIGHT_TRY(opened.objects, ObjectsOf(*opened.file, folder, scan));
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
  Q_EMIT opened();
  Q_EMIT changed();
}

void ReviewViewModel::close() {
  loader_.cancel();
  file_.reset();
  scans_.clear();
  scan_index_ = -1;
  session_->ShowObjects({});
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
  Keep(std::move(body), [this, object_uuid](const Status& kept) {
    if (!kept)
      session_->Report(NoticeOf(tr("Keeping the review"), kept.error()));
    else if (!object_uuid.empty())
      session_->MarkKept(object_uuid);
  });
}

void ReviewViewModel::Keep(std::function<Status(MissionFile*)> body,
                           std::function<void(const Status&)> kept) {
  if (!file_) return;
  writer_.Run<bool>(
      tr("Keeping the review"),
      [mission = file_->path(), folder = ReviewFolder(),
       body = std::move(body)](const RunContext&) -> Result<bool> {
        FORESIGHT_TRY(const auto notes, MissionFile::OpenReviewOf(mission, folder));
        FORESIGHT_CHECK(body(notes.get()));
        FORESIGHT_CHECK(notes->Close());
        return true;
      },
      [kept = std::move(kept)](const Result<bool>& written) {
        kept(written ? Status() : tl::unexpected(written.error()));
      });
}

std::filesystem::path ReviewViewModel::ReviewFolder() {
  return RecordingViewModel::DefaultFolder().toStdString();
}

}  // namespace foresight
