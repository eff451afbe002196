#include "ui/viewmodels/scan_flow.h"

#include <algorithm>

#include "core/registration/final_part.h"

namespace foresight {

ScanFlow::ScanFlow(HeadViewModel* head, SessionModel* session, QObject* parent)
    : QObject(parent), head_(head), session_(session) {
  connect(head, &HeadViewModel::scanStarted, this, &ScanFlow::Begin);
  connect(head, &HeadViewModel::scanGrew, this, &ScanFlow::Grow);
  connect(head, &HeadViewModel::scanCame, this, &ScanFlow::Come);
  connect(head, &HeadViewModel::scanEnded, this, &ScanFlow::End);
  connect(head, &HeadViewModel::scanLost, session, &SessionModel::GiveUpScan);
  connect(head, &HeadViewModel::noticed, session, &SessionModel::Report);
}

void ScanFlow::Begin() {
  // Nothing of an older scan stays on the screen while a new one runs.
  session_->ExpectScan();
  points_ = std::make_shared<GrowingRegistration>();
}

void ScanFlow::Grow(const std::shared_ptr<const Scan>& scan) {
  session_->SetArriving(scan);
  if (runner_.Busy()) return;  // the next look shows more
  runner_.Run<Placed>(
      tr("Placing points"),
      [scan, points = points_](const RunContext& context) -> Result<Placed> {
        FORESIGHT_TRY(RegisteredScan cloud, points->Update(*scan, context));
        return Placed{std::move(cloud), std::make_shared<const Scan>(FinalPart(*scan))};
      },
      [this, of_lines = head_->LastStatus().expected_lines](Result<Placed> placed) {
        Show(std::move(placed), of_lines);
      });
}

/// What is behind a gap may change with the next look, so it is placed as a whole.
void ScanFlow::Come(const std::shared_ptr<const EarlyScan>& early) {
  session_->SetArriving(early->scan);
  if (early->cloud) {
    runner_.cancel();
    session_->SetCloud(early->cloud, early->scan->rig, {nullptr, early->lines, early->of_lines});
    return;
  }
  if (runner_.Busy() || early->scan->lines.empty()) return;
  runner_.Run<Placed>(
      tr("Placing points"),
      [scan = early->scan](const RunContext& context) -> Result<Placed> {
        auto part = std::make_shared<const Scan>(FinalPart(*scan));
        FORESIGHT_TRY(RegisteredScan cloud, RegisterScan(*part, context));
        return Placed{std::move(cloud), std::move(part)};
      },
      [this, of_lines = early->of_lines](Result<Placed> placed) {
        Show(std::move(placed), of_lines);
      });
}

void ScanFlow::Show(Result<Placed> placed, int of_lines) {
  // Too few points yet, or the whole scan has come meanwhile.
  if (!placed || !head_->Scanning()) return;
  const int lines = placed->cloud.lines;
  session_->SetCloud(std::make_shared<const RegisteredScan>(std::move(placed->cloud)),
                     placed->part->rig, {placed->part, lines, std::max(lines, of_lines)});
}

void ScanFlow::End(const std::shared_ptr<const Scan>& scan) {
  runner_.cancel();
  const bool late_lines = session_->CurrentScan() && session_->CurrentScan()->uuid == scan->uuid;
  if (scan->state != ScanState::kComplete && !late_lines) {
    const QString reason = QString::fromStdString(scan->reason);
    session_->Report({Notice::Level::kWarning,
                      tr("The scan was %1%2.")
                          .arg(QString::fromUtf8(ToString(scan->state)),
                               reason.isEmpty() ? QString() : QStringLiteral(": ") + reason),
                      scan->lines.empty()
                          ? tr("Nothing was measured. Scan again when the cause is gone.")
                          : tr("What was measured until then is shown."),
                      kScanTopic});
  }
  if (scan->lines.empty())
    session_->GiveUpScan();
  else
    session_->SetScan(scan);
}

}  // namespace foresight
