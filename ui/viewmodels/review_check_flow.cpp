#include "ui/viewmodels/review_check_flow.h"

namespace foresight {

ReviewCheckFlow::ReviewCheckFlow(ReviewViewModel* review, SessionModel* session,
                                 ScanCheckModel* check, QObject* parent)
    : QObject(parent), review_(review), session_(session), check_(check) {
  // The model has heard of the scan first: it was there before this object.
  connect(session_, &SessionModel::scanChanged, this, [this] {
    asked_for_.clear();  // shown anew, it is looked for anew
    FindKept();
  });
  connect(review_, &ReviewViewModel::changed, this, &ReviewCheckFlow::FindKept);
  connect(check_, &ScanCheckModel::checked, this, &ReviewCheckFlow::Keep);
}

void ReviewCheckFlow::FindKept() {
  const auto scan = session_->CurrentScan();
  const auto mission = review_->File();
  if (!scan || !mission || check_->Now() != ScanCheckModel::State::kNotChecked) return;
  // The review changes with every task: what was looked for is not looked for again.
  if (asked_for_ == scan->uuid) return;
  asked_for_ = scan->uuid;
  ++read_count_;
  check_->BeginMission();
  using Found = std::vector<KeptCheck>;
  reader_.Run<Found>(
      tr("Reading the self-check"),
      [mission, folder = ReviewFolder()](const RunContext&) -> Result<Found> {
        FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(mission->path(), folder));
        return NewestScanChecks(*mission, review.get());
      },
      [this, uuid = scan->uuid](const Result<Found>& found) {
        if (!found) {
          asked_for_.clear();
          session_->Report(NoticeOf(tr("Reading the self-check"), found.error()));
          return;
        }
        check_->AddKept(*found);
        if (check_->Now() == ScanCheckModel::State::kNotChecked) ShowNewest(*found, uuid);
      });
}

void ReviewCheckFlow::ShowNewest(const std::vector<KeptCheck>& checks,
                                 const std::string& scan_uuid) {
  const KeptCheck* newest = nullptr;
  for (const KeptCheck& check : checks)
    if (check.scan_uuid == scan_uuid && (newest == nullptr || check.utc_ns >= newest->utc_ns))
      newest = &check;
  if (newest != nullptr) check_->ShowKept(*newest);
}

void ReviewCheckFlow::Keep(const KeptCheck& check) {
  review_->Keep([check](MissionFile* review) { return AddScanCheck(*review, check); },
                [this](const Status& kept) {
                  if (!kept) session_->Report(NoticeOf(tr("Keeping the self-check"), kept.error()));
                });
}

}  // namespace foresight
