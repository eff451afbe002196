#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "hardware/link/server/burst_session.h"
#include "sensor_head.pb.h"

namespace foresight {

/// Opens burst paths for operators: one at a time, for a head has one radio. Safe from any thread.
class BurstDesk {
 public:
  static constexpr double kUsualBytesPerS = 250e6 / 8.0;

  /// `bytes_per_s` on the wire; 0 = no bursts. `shelf` outlives it.
  BurstDesk(ScanShelf& shelf, double bytes_per_s) : shelf_(shelf), bytes_per_s_(bytes_per_s) {}

  /// `caller` is who asks, and `address` where from, as gRPC names it. A path that this operator
  /// had before is closed. Fails with kInvalidInput where the request says nonsense, kState where
  /// another operator's path is open or there are no bursts, kDevice.
  Result<link::BurstReply> Open(const link::BurstRequest& request, const std::string& caller,
                                const std::string& address);
  /// Of that key and owner; nullptr where it is closed.
  std::shared_ptr<BurstSession> Find(std::uint32_t key_id, const std::string& owner) const;

 private:
  ScanShelf& shelf_;
  const double bytes_per_s_;
  mutable std::mutex mutex_;
  std::shared_ptr<BurstSession> session_;
};

}  // namespace foresight
