#include "ui/viewmodels/fit_view_model.h"

namespace foresight {
FitViewModel::FitViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  for (auto signal : {&SessionModel::cloudChanged, &SessionModel::depthChanged,
                      &SessionModel::roiChanged, &SessionModel::scanChanged})
    connect(session_, signal, this, &FitViewModel::changed);
  connect(session_, &SessionModel::scanChanged, &runner_, &TaskRunner::cancel);
  connect(&runner_, &TaskRunner::changed, this, &FitViewModel::changed);
}

void FitViewModel::SetSource(FitSource source) {
  source_ = source;
  Q_EMIT changed();
}

void FitViewModel::setValveTool(bool on) {
  valve_tool_ = on;
  if (on) roi_tool_ = false;
  Q_EMIT changed();
}

void FitViewModel::setRoiTool(bool on) {
  roi_tool_ = on;
  if (on) valve_tool_ = false;
  Q_EMIT changed();
}

void FitViewModel::leaveTools() {
  valve_tool_ = roi_tool_ = false;
  Q_EMIT changed();
}

bool FitViewModel::CanFit() const {
  const bool has_points =
      source_ == FitSource::kRaw ? session_->Cloud() != nullptr : session_->Depth() != nullptr;
  return session_->CurrentScan() && session_->Roi() && has_points && !runner_.Busy();
}

void FitViewModel::DrawRoi(const Eigen::Vector2d& corner_a, const Eigen::Vector2d& corner_b) {
  const CameraFrame* picture = session_->Picture();
  if (picture == nullptr) return;
  const ImageRoi roi = ImageRoi::Rectangle(picture->motor_angle_rad, corner_a, corner_b);
  if (!roi.Check()) return;
  session_->SetRoi(roi);
  if (valve_tool_) fit();
}

void FitViewModel::fit() {
  if (!session_->CurrentScan() || !session_->Roi()) return;
  if (!CanFit() && !runner_.Busy()) {
    session_->Report({Notice::Level::kWarning, tr("There are no points to fit to yet."),
                      tr("Wait until the depth is computed, then press Fit valve.")});
    return;
  }
  const auto work = [scan = session_->CurrentScan(), cloud = session_->Cloud(),
                     depth = session_->Depth(), mask = session_->Mask(), roi = *session_->Roi(),
                     source = source_](const RunContext& context) -> Result<ValveDetection> {
    const ProcessedScan processed{scan->rig, *cloud, depth.get(), mask.get()};
    return FitValveInScan(processed, source, roi, FitValveOptions(), context);
  };
  runner_.Run<ValveDetection>(tr("Fitting the valve"), work,
                              [this, scan = session_->CurrentScan()](
                                  const Result<ValveDetection>& found) { Accept(scan, found); });
}

void FitViewModel::Accept(const std::shared_ptr<const Scan>& scan,
                          const Result<ValveDetection>& detection) {
  if (!detection) {
    session_->Report(NoticeOf(tr("Fitting the valve"), detection.error()));
    return;
  }
  if (scan != session_->CurrentScan()) return;
  FoundValve valve;
  valve.detection = *detection;
  valve.rig = scan->rig;
  valve.scan_uuid = scan->uuid;
  valve.scan_time = session_->ScanTime();
  session_->AddValve(valve);
  Q_EMIT valveFound(valve);
}

}  // namespace foresight
