#include "hardware/link/server/stop_shelf.h"

namespace foresight {

void StopShelf::OnStop(const StopCapture& capture) {
  auto kept = std::make_shared<const StopCapture>(capture);
  const std::lock_guard lock(mutex_);
  captures_.push_back(std::move(kept));
  wake_.notify_all();
}

void StopShelf::OnStopsEnded(ScanState state, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  end_ = End{state, reason};
  wake_.notify_all();
}

StopShelf::News StopShelf::Wait(std::size_t from, std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, timeout, [&] { return from < captures_.size() || end_; });
  if (from < captures_.size()) return {captures_[from], std::nullopt};
  return {nullptr, end_};
}

}  // namespace foresight
