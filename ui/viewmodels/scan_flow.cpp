#include "ui/viewmodels/scan_flow.h"

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
  runner_.Run<RegisteredScan>(
      tr("Placing points"),
      [scan, points = points_](const RunContext& context) {
        return points->Update(*scan, context);
      },
      [this, scan](Result<RegisteredScan> cloud) { ShowCloud(std::move(cloud), *scan); });
}

/// What is behind a gap may change with the next look, so it is placed as a whole.
void ScanFlow::Come(const std::shared_ptr<const EarlyScan>& early) {
  session_->SetArriving(early->scan);
  if (early->cloud) {
    runner_.cancel();
    session_->SetCloud(early->cloud, early->scan->rig);
    return;
  }
  if (runner_.Busy() || early->scan->lines.empty()) return;
  runner_.Run<RegisteredScan>(
      tr("Placing points"),
      [scan = early->scan](const RunContext& context) { return RegisterScan(*scan, context); },
      [this, scan = early->scan](Result<RegisteredScan> cloud) {
        ShowCloud(std::move(cloud), *scan);
      });
}

void ScanFlow::ShowCloud(Result<RegisteredScan> cloud, const Scan& scan) {
  // Too few points yet, or the whole scan has come meanwhile.
  if (!cloud || !head_->Scanning()) return;
  session_->SetCloud(std::make_shared<const RegisteredScan>(std::move(*cloud)), scan.rig);
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
