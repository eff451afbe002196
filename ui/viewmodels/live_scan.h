#pragma once

#include <memory>
#include <mutex>

#include "hardware/api/sensor_head.h"

namespace foresight {

/// Collects a scan while it arrives on a thread of the head, and lets the GUI look at it.
class LiveScan : public ScanSink {
 public:
  void OnScanStarted(const Scan& header) override;
  void OnLine(const LidarLine& line) override;
  void OnMotorSamples(std::span<const MotorSample> samples) override;
  void OnFrame(const CameraFrame& frame) override;
  void OnScanEnded(ScanState state, const std::string& reason) override;

  bool Ended() const;
  /// A copy of what has come so far.
  std::shared_ptr<const Scan> Snapshot() const;

 private:
  mutable std::mutex mutex_;
  Scan scan_;
};

}  // namespace foresight
