#include "ui/viewmodels/mission_view_model.h"

#include "ui/viewmodels/mission_storage.h"

namespace foresight {

struct MissionViewModel::Opened {
  std::shared_ptr<MissionFile> file;
  std::vector<ScanSummary> scans;
  int index = -1;
  std::shared_ptr<const Scan> scan;
  std::vector<FoundObject> objects;
};

MissionViewModel::MissionViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  connect(&runner_, &TaskRunner::changed, this, &MissionViewModel::changed);
}

std::shared_ptr<ScanSink> MissionViewModel::Recorder() const {
  if (runner_.Busy()) return nullptr;
  return recorder_;
}

QString MissionViewModel::Path() const {
  return file_ ? QString::fromStdString(file_->path().string()) : QString();
}

void MissionViewModel::Open(const QString& path) {
  const auto work = [path = path.toStdString()](const RunContext& context) -> Result<Opened> {
    context.Report(0.1, "reading");
    Opened opened;
    FORESIGHT_TRY(opened.file, MissionFile::OpenReadOnly(path));
    FORESIGHT_TRY(opened.scans, opened.file->ListScans());
    if (opened.scans.empty())
      return Fail(ErrorCode::kBadData, "{}: the mission holds no scan", path);
    opened.index = static_cast<int>(opened.scans.size()) - 1;
    const std::int64_t id = opened.scans.back().id;
    FORESIGHT_TRY(Scan scan, opened.file->LoadScan(id));
    FORESIGHT_TRY(opened.objects, ObjectsInMission(*opened.file, id, scan));
    opened.scan = std::make_shared<const Scan>(std::move(scan));
    return opened;
  };
  runner_.Run<Opened>(tr("Opening the mission"), work,
                      [this](Result<Opened> opened) { ShowOpened(std::move(opened)); });
}

void MissionViewModel::showScan(int index) {
  if (!file_ || index < 0 || index >= static_cast<int>(scans_.size())) return;
  const auto work = [file = file_, scans = scans_, index](const RunContext&) -> Result<Opened> {
    Opened opened{file, scans, index, nullptr, {}};
    const std::int64_t id = scans[static_cast<std::size_t>(index)].id;
    FORESIGHT_TRY(Scan scan, file->LoadScan(id));
    FORESIGHT_TRY(opened.objects, ObjectsInMission(*file, id, scan));
    opened.scan = std::make_shared<const Scan>(std::move(scan));
    return opened;
  };
  runner_.Run<Opened>(tr("Loading the scan"), work,
                      [this](Result<Opened> opened) { ShowOpened(std::move(opened)); });
}

void MissionViewModel::ShowOpened(Result<Opened> opened) {
  if (!opened) {
    session_->Report(NoticeOf(tr("Opening the mission"), opened.error()));
    return;
  }
  recorder_.reset();
  file_ = opened->file;
  scans_ = opened->scans;
  scan_index_ = opened->index;
  session_->SetMode(SessionMode::kReplay);
  session_->ClearObjects();
  session_->SetScan(opened->scan);
  for (const FoundObject& object : opened->objects) session_->AddObject(object);
  Q_EMIT changed();
}

void MissionViewModel::SaveAs(const QString& path) {
  if (unsaved_scans_.empty() && !(session_->Mode() == SessionMode::kReplay && file_)) {
    session_->Report(
        {Notice::Level::kWarning, tr("There is no scan to save yet."), tr("Press Scan first.")});
    return;
  }
  if (session_->Mode() == SessionMode::kReplay) {
    runner_.Run<bool>(
        tr("Copying the mission"),
        [file = file_, path = path.toStdString()](const RunContext&) -> Result<bool> {
          FORESIGHT_CHECK(file->ExportTo(path));
          return true;
        },
        [this, path](const Result<bool>& copied) {
          session_->Report(copied ? Notice{Notice::Level::kInfo, tr("Saved %1.").arg(path), {}}
                                  : NoticeOf(tr("Copying the mission"), copied.error()));
        });
    return;
  }
  runner_.Run<std::shared_ptr<MissionFile>>(
      tr("Making the mission file"),
      [path = path.toStdString()](const RunContext&) -> Result<std::shared_ptr<MissionFile>> {
        FORESIGHT_TRY(std::shared_ptr<MissionFile> file, MissionFile::Create(path));
        return file;
      },
      [this](Result<std::shared_ptr<MissionFile>> file) {
        if (!file) {
          session_->Report(NoticeOf(tr("Saving the mission"), file.error()));
          return;
        }
        file_ = std::move(*file);
        recorder_ = std::make_shared<ScanRecorder>(file_);
        scans_.clear();
        scan_index_ = -1;
        Save();
      });
}

void MissionViewModel::keepScan(const std::shared_ptr<const Scan>& scan) {
  if (scan->lines.empty()) return;
  if (!recorder_) {  // a mission that is shown is never written to
    file_.reset();
    scans_.clear();
    scan_index_ = -1;
  }
  unsaved_scans_.push_back(scan);
  Save();
}

void MissionViewModel::keepObject(const FoundObject& object) {
  if (session_->Mode() == SessionMode::kReplay) return;
  unsaved_objects_.push_back(object);
  Save();
}

void MissionViewModel::Save() {
  Q_EMIT changed();
  if (!recorder_ || runner_.Busy()) return;  // what comes meanwhile is saved afterwards
  if (unsaved_scans_.empty() && unsaved_objects_.empty()) return;
  const auto scans = unsaved_scans_;
  const auto objects = unsaved_objects_;
  runner_.Run<bool>(
      tr("Saving the mission"),
      [file = file_, recorder = recorder_, scans,
       objects](const RunContext& context) -> Result<bool> {
        // kState: this recorder has not had a scan yet.
        const auto written = recorder->WaitUntilWritten();
        if (!written && written.error().code != ErrorCode::kState)
          return tl::unexpected(written.error());
        FORESIGHT_CHECK(AppendToMission(file.get(), scans, objects, context));
        return true;
      },
      [this, scan_count = scans.size(), object_count = objects.size()](const Result<bool>& saved) {
        if (!saved) {
          recorder_.reset();  // what was not saved stays in memory for another Save as
          session_->Report(NoticeOf(tr("Saving the mission"), saved.error()));
          return;
        }
        unsaved_scans_.erase(unsaved_scans_.begin(),
                             unsaved_scans_.begin() + static_cast<std::ptrdiff_t>(scan_count));
        unsaved_objects_.erase(
            unsaved_objects_.begin(),
            unsaved_objects_.begin() + static_cast<std::ptrdiff_t>(object_count));
        Save();
      });
}

}  // namespace foresight
