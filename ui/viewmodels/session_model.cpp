#include "ui/viewmodels/session_model.h"

#include <cmath>

namespace foresight {

SessionModel::SessionModel(SessionMode mode, QObject* parent) : QObject(parent), mode_(mode) {
  qRegisterMetaType<Notice>("foresight::Notice");
}

void SessionModel::SetMode(SessionMode mode) {
  mode_ = mode;
  Q_EMIT modeChanged();
}

void SessionModel::SetScan(std::shared_ptr<const Scan> scan) {
  scan_ = std::move(scan);
  expects_scan_ = false;
  picture_ = -1;  // all of it before the first signal: who hears one may ask for anything
  depth_.reset();
  mask_.reset();
  cloud_.reset();
  roi_.reset();
  roi_history_.clear();
  Q_EMIT scanChanged();
  Q_EMIT cloudChanged();
  Q_EMIT roiChanged();
  Q_EMIT valvesChanged();  // those of the scan before are no longer current
  SelectPicture(scan_ && !scan_->frames.empty() ? 0 : -1);
}

void SessionModel::ExpectScan() {
  SetScan(nullptr);
  expects_scan_ = true;
  Q_EMIT scanChanged();
}

void SessionModel::GiveUpScan() {
  expects_scan_ = false;
  Q_EMIT scanChanged();
}

QDateTime SessionModel::ScanTime() const {
  if (!scan_ || scan_->start_utc_ns == 0) return {};
  return QDateTime::fromMSecsSinceEpoch(scan_->start_utc_ns / 1'000'000);
}

void SessionModel::SelectPicture(int index) {
  const int count = scan_ ? static_cast<int>(scan_->frames.size()) : 0;
  picture_ = index >= 0 && index < count ? index : -1;
  Q_EMIT pictureChanged();
  SetDepth(nullptr);
}

const CameraFrame* SessionModel::Picture() const {
  return picture_ < 0 ? nullptr : &scan_->frames[static_cast<std::size_t>(picture_)];
}

void SessionModel::SetCloud(std::shared_ptr<const RegisteredScan> cloud, const SensorRig& rig) {
  cloud_ = std::move(cloud);
  rig_ = rig;
  Q_EMIT cloudChanged();
}

void SessionModel::SetDepth(std::shared_ptr<const DepthResult> depth) {
  depth_ = std::move(depth);
  mask_ = depth_ ? std::make_shared<const MaskImage>(depth_->mask) : nullptr;
  Q_EMIT depthChanged();
}

void SessionModel::SetMask(std::shared_ptr<const MaskImage> mask) {
  mask_ = std::move(mask);
  Q_EMIT maskChanged();
}

void SessionModel::SetRoi(std::optional<ImageRoi> roi) {
  roi_history_.push_back(roi_);
  roi_ = std::move(roi);
  Q_EMIT roiChanged();
}

void SessionModel::undoRoi() {
  if (roi_history_.empty()) return;
  roi_ = std::move(roi_history_.back());
  roi_history_.pop_back();
  Q_EMIT roiChanged();
}

void SessionModel::AddValve(FoundValve valve) {
  valves_.push_back(std::move(valve));
  SelectValve(static_cast<int>(valves_.size()) - 1);
}

void SessionModel::ClearValves() {
  valves_.clear();
  SelectValve(-1);
}

void SessionModel::SelectValve(int index) {
  selected_valve_ = index >= 0 && index < static_cast<int>(valves_.size()) ? index : -1;
  Q_EMIT valvesChanged();
}

bool SessionModel::IsCurrent(const FoundValve& valve) const {
  return scan_ && scan_->uuid == valve.scan_uuid;
}

}  // namespace foresight
