#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "core/mission/scan_workbench.h"
#include "hardware/link/server/command_log.h"
#include "hardware/link/server/scan_shelf.h"
#include "sensor_head.pb.h"

namespace foresight {

/// Fits in the head's scans for stations behind a thin link: one at a time, on a thread that lets
/// the sweep and the streams go first. A fit outlives the call that asked for it, because a
/// blackout ends calls: who asks again with the same id gets its answer. Safe from any thread.
class FitDesk {
 public:
  /// The shelf outlives this.
  explicit FitDesk(ScanShelf& shelf) : shelf_(shelf) {}
  ~FitDesk();
  FitDesk(const FitDesk&) = delete;
  FitDesk& operator=(const FitDesk&) = delete;

  /// Waits for the answer, or until `gone()`. A caller's new fit takes the place of the caller's
  /// last one. A fit that was made and found nothing is an answer with an error in it. Fails with
  /// kInvalidInput for an order that cannot be read, kState while somebody else's fit is made,
  /// kCancelled where the caller is gone.
  Result<link::FitReply> Fit(const link::FitRequest& request, const std::string& caller,
                             const std::function<bool()>& gone);

 private:
  struct Order {
    std::string command_id, caller, scan_id;
    Provenance provenance;
    link::ImageChoice image = link::AS_THE_PROVENANCE_SAYS;
  };

  static Result<Order> OrderFrom(const link::FitRequest& request, const std::string& caller);
  Status Begin(Order order, std::unique_lock<std::mutex>& lock);
  void Work(const Order& order, const std::stop_token& stop);
  Result<link::FitReply> Make(const Order& order, const RunContext& context);

  ScanShelf& shelf_;
  ScanWorkbench bench_;  ///< of the worker's thread alone
  std::mutex mutex_;     ///< guards what follows
  std::condition_variable changed_;
  CommandLog<link::FitReply> log_;
  std::string running_id_;  ///< empty = none
  std::string running_for_;
  std::jthread worker_;
};

}  // namespace foresight
