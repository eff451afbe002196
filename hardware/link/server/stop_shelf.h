#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hardware/api/stop_capture.h"

namespace foresight {

/// What was captured at the stops of the last run of them, until the next run begins: a station
/// whose link broke asks again from where it was. Safe from any thread.
class StopShelf final : public StopSink {
 public:
  explicit StopShelf(std::string id) : id_(std::move(id)) {}

  void OnStop(const StopCapture& capture) override;
  void OnStopsEnded(ScanState state, const std::string& reason) override;

  struct End {
    ScanState state = ScanState::kRunning;
    std::string reason;
  };
  struct News {
    std::shared_ptr<const StopCapture> capture;  ///< number `from`; null = not there (yet)
    std::optional<End> end;  ///< all captures are there and this is how it ended
  };
  /// Waits a little for the capture of that number, or for the end.
  News Wait(std::size_t from, std::chrono::milliseconds timeout) const;
  const std::string& id() const { return id_; }

 private:
  const std::string id_;
  mutable std::mutex mutex_;
  mutable std::condition_variable wake_;
  std::vector<std::shared_ptr<const StopCapture>> captures_;
  std::optional<End> end_;
};

}  // namespace foresight
