#include "ui/viewmodels/live_check_flow.h"

namespace foresight {

LiveCheckFlow::LiveCheckFlow(RecordingViewModel* recording, SessionModel* session,
                             ScanCheckModel* check, QObject* parent)
    : QObject(parent), recording_(recording), session_(session), check_(check) {
  connect(check_, &ScanCheckModel::checked, recording_, &RecordingViewModel::keepCheck);
  connect(recording_, &RecordingViewModel::changed, this, &LiveCheckFlow::FollowMission);
}

void LiveCheckFlow::FollowMission() {
  if (recording_->Path() != path_) {
    path_ = recording_->Path();
    asked_ = false;
    reader_.cancel();
    const auto& scan = session_->CurrentScan();
    check_->BeginMission(scan ? scan->uuid : std::string());
  }
  // Its scans are listed after the file is opened.
  if (asked_ || recording_->Scans().empty()) return;
  asked_ = true;
  using Found = std::vector<KeptCheck>;
  reader_.Run<Found>(
      tr("Reading the self-checks"),
      [path = path_.toStdString()](const RunContext&) -> Result<Found> {
        FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
        return NewestScanChecks(*mission, nullptr);
      },
      [this, path = path_](const Result<Found>& found) {
        if (path != path_) return;
        if (found)
          check_->AddKept(*found);
        else
          session_->Report(NoticeOf(tr("Reading the self-checks"), found.error()));
      });
}

}  // namespace foresight
