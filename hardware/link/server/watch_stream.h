#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>

#include "hardware/link/server/head_desk.h"
#include "sensor_head.grpc.pb.h"

namespace foresight {

/// One station's view of the head: takes its signs of life, and sends what changed.
class WatchStream {
 public:
  using Stream = grpc::ServerReaderWriter<link::Event, link::SignOfLife>;

  /// `still_good` is asked at each sign of life.
  WatchStream(HeadDesk& desk, grpc::ServerContext& context, Stream& stream,
              std::function<bool()> still_good)
      : desk_(desk), context_(context), stream_(stream), still_good_(std::move(still_good)) {}

  /// Until the station is gone or `closing`.
  void Run(const std::atomic<bool>& closing);

 private:
  void Read();
  link::SignOfLife LastSign();
  link::Event Compose(const link::SignOfLife& sign) const;
  bool Due(const link::Event& event, double rate_hz) const;
  bool Send(link::Event event, bool fast);

  HeadDesk& desk_;
  grpc::ServerContext& context_;
  Stream& stream_;
  const std::function<bool()> still_good_;

  std::atomic<bool> gone_{false};
  std::mutex mutex_;
  link::SignOfLife sign_;  ///< the last one; guarded by the mutex

  // The writing thread's own:
  link::Event sent_;
  double sent_s_ = -1e9;
  double health_s_ = -1e9;
  double scans_s_ = -1e9;
  std::int64_t news_ = -1;  ///< of the shelf, that the station has heard
};

/// A scan on the shelf as the stations hear of it.
link::ScanOnHead ToMessage(const ShelvedScan& scan);

}  // namespace foresight
