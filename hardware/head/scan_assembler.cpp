#include "hardware/head/scan_assembler.h"

#include "core/base/contract.h"

namespace foresight {

void ScanAssembler::OnScanStarted(const Scan& header) {
  const std::lock_guard lock(mutex_);
  scan_ = std::make_unique<Scan>(header);
  snapshot_.reset();
}

void ScanAssembler::OnLine(const LidarLine& line) {
  const std::lock_guard lock(mutex_);
  FORESIGHT_EXPECTS(scan_ != nullptr, "a scan starts before its lines");
  scan_->lines.push_back(line);
  snapshot_.reset();
}

void ScanAssembler::OnMotorSamples(std::span<const MotorSample> samples) {
  const std::lock_guard lock(mutex_);
  FORESIGHT_EXPECTS(scan_ != nullptr, "a scan starts before its motor samples");
  for (const MotorSample& sample : samples) scan_->track.Add(sample);
  snapshot_.reset();
}

void ScanAssembler::OnFrame(const CameraFrame& frame) {
  const std::lock_guard lock(mutex_);
  FORESIGHT_EXPECTS(scan_ != nullptr, "a scan starts before its frames");
  scan_->frames.push_back(frame);
  snapshot_.reset();
}

void ScanAssembler::OnScanEnded(ScanState state, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  FORESIGHT_EXPECTS(scan_ != nullptr, "a scan starts before it ends");
  scan_->state = state;
  scan_->reason = reason;
  snapshot_.reset();
}

std::shared_ptr<const Scan> ScanAssembler::Snapshot() const {
  const std::lock_guard lock(mutex_);
  if (!snapshot_ && scan_) snapshot_ = std::make_shared<const Scan>(*scan_);
  return snapshot_;
}

}  // namespace foresight
