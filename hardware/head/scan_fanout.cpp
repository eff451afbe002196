#include "hardware/head/scan_fanout.h"

#include "core/base/contract.h"

namespace foresight {

ScanFanout::ScanFanout(std::vector<std::shared_ptr<ScanSink>> sinks) : sinks_(std::move(sinks)) {
  for (const auto& sink : sinks_) FORESIGHT_EXPECTS(sink != nullptr, "every sink is there");
}

void ScanFanout::OnScanStarted(const Scan& header) {
  for (const auto& sink : sinks_) sink->OnScanStarted(header);
}

void ScanFanout::OnLine(const LidarLine& line) {
  for (const auto& sink : sinks_) sink->OnLine(line);
}

void ScanFanout::OnMotorSamples(std::span<const MotorSample> samples) {
  for (const auto& sink : sinks_) sink->OnMotorSamples(samples);
}

void ScanFanout::OnFrame(const CameraFrame& frame) {
  for (const auto& sink : sinks_) sink->OnFrame(frame);
}

std::optional<std::string> ScanFanout::Failure() const {
  for (const auto& sink : sinks_)
    if (auto failure = sink->Failure()) return failure;
  return std::nullopt;
}

void ScanFanout::OnDeviceHealth(const HeadHealth& at_start, const HeadHealth& at_end) {
  for (const auto& sink : sinks_) sink->OnDeviceHealth(at_start, at_end);
}

void ScanFanout::OnScanEnded(ScanState state, const std::string& reason) {
  for (const auto& sink : sinks_) sink->OnScanEnded(state, reason);
}

Status ScanFanout::WaitUntilKept() {
  Status kept;
  for (const auto& sink : sinks_) {
    const Status here = sink->WaitUntilKept();
    if (kept && !here) kept = here;
  }
  return kept;
}

}  // namespace foresight
