#pragma once

#include <memory>
#include <vector>

#include "hardware/api/sensor_head.h"

namespace foresight {

/// Hands a scan to several sinks, in their order.
class ScanFanout final : public ScanSink {
 public:
  explicit ScanFanout(std::vector<std::shared_ptr<ScanSink>> sinks);

  void OnScanStarted(const Scan& header) override;
  void OnLine(const LidarLine& line) override;
  void OnMotorSamples(std::span<const MotorSample> samples) override;
  void OnFrame(const CameraFrame& frame) override;
  /// The first of the sinks that cannot keep the scan.
  std::optional<std::string> Failure() const override;
  void OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) override;
  void OnScanEnded(ScanState state, const std::string& reason) override;
  /// All of them; the first error of those that cannot.
  Status WaitUntilKept() override;

 private:
  std::vector<std::shared_ptr<ScanSink>> sinks_;
};

}  // namespace foresight
