#pragma once

#include <memory>
#include <mutex>

#include "hardware/api/sensor_head.h"

namespace foresight {

/// Collects a scan in memory while it arrives. Snapshot may be called from any thread.
class ScanAssembler final : public ScanSink {
 public:
  void OnScanStarted(const Scan& header) override;
  void OnLine(const LidarLine& line) override;
  void OnMotorSamples(std::span<const MotorSample> samples) override;
  void OnFrame(const CameraFrame& frame) override;
  void OnScanEnded(ScanState state, const std::string& reason) override;

  /// What has arrived so far; never changes afterwards. nullptr before the first scan. Costs the
  /// same however much has arrived.
  std::shared_ptr<const Scan> Snapshot() const;

 private:
  mutable std::mutex mutex_;
  std::unique_ptr<Scan> scan_;
  mutable std::shared_ptr<const Scan> snapshot_;  ///< empty when out of date
};

}  // namespace foresight
