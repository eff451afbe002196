#include "ui/viewmodels/live_scan.h"

namespace foresight {

void LiveScan::OnScanStarted(const Scan& header) {
  const std::lock_guard lock(mutex_);
  scan_ = header;
  scan_.state = ScanState::kRunning;
}

void LiveScan::OnLine(const LidarLine& line) {
  const std::lock_guard lock(mutex_);
  scan_.lines.push_back(line);
}

void LiveScan::OnMotorSamples(std::span<const MotorSample> samples) {
  const std::lock_guard lock(mutex_);
  for (const MotorSample& sample : samples) scan_.track.Add(sample);
}

void LiveScan::OnFrame(const CameraFrame& frame) {
  const std::lock_guard lock(mutex_);
  scan_.frames.push_back(frame);
}

void LiveScan::OnScanEnded(ScanState state, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  scan_.state = state;
  scan_.reason = reason;
}

bool LiveScan::Ended() const {
  const std::lock_guard lock(mutex_);
  return scan_.state != ScanState::kRunning;
}

std::shared_ptr<const Scan> LiveScan::Snapshot() const {
  const std::lock_guard lock(mutex_);
  return std::make_shared<const Scan>(scan_);
}

}  // namespace foresight
