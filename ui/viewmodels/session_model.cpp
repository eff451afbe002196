#include "ui/viewmodels/session_model.h"

#include <cmath>

#include "core/detection/candidates.h"

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
  Q_EMIT objectsChanged();  // those of the scan before are no longer current
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

void SessionModel::SetRoi(std::optional<Roi> roi) {
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

void SessionModel::AddObject(FoundObject object) {
  objects_.push_back(std::move(object));
  SelectObject(static_cast<int>(objects_.size()) - 1);
}

void SessionModel::ClearObjects() {
  objects_.clear();
  SelectObject(-1);
}

void SessionModel::SelectObject(int index) {
  selected_object_ = index >= 0 && index < static_cast<int>(objects_.size()) ? index : -1;
  candidate_ = 0;
  Q_EMIT objectsChanged();
}

const FoundObject* SessionModel::Selected() const {
  return selected_object_ < 0 ? nullptr : &objects_[static_cast<std::size_t>(selected_object_)];
}

void SessionModel::StepCandidate(int by) {
  const FoundObject* object = Selected();
  if (object == nullptr) return;
  const int count = CandidateCount(object->detection);
  if (count < 2) return;
  candidate_ = (candidate_ + by + count) % count;
  Q_EMIT objectsChanged();
}

bool SessionModel::IsCurrent(const FoundObject& object) const {
  return scan_ && scan_->uuid == object.scan_uuid;
}

}  // namespace foresight
