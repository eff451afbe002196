#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

#include "hardware/link/client/link_session.h"

namespace foresight {

/// Keeps the stream of the head's status open, through whatever happens to the link: identifies
/// itself, takes control, sends the operator's signs of life and hands on what comes.
class WatchClient {
 public:
  struct Hooks {
    std::function<void(const link::Event&)> on_event;
    std::function<void()>
        on_begin;  ///< the head has identified itself: what is known of it may be old
    std::function<void(const Error&)> on_lost;
  };

  /// `session` outlives it. Hooks are called from its threads, one at a time.
  WatchClient(LinkSession& session, double status_rate_hz, Hooks hooks);
  ~WatchClient();

  /// Somebody is there; sent once a second while it is called.
  void OperatorSeen() { seen_s_ = LinkSession::Now(); }

 private:
  void Work(const std::stop_token& stop);
  Status Watch(const std::stop_token& stop);
  void Sign(const std::stop_token& stop, grpc::ClientReaderWriter<link::SignOfLife, link::Event>&);

  LinkSession& session_;
  const double status_rate_hz_;
  const Hooks hooks_;
  std::atomic<double> seen_s_{-1e9};
  std::mutex mutex_;  ///< guards what follows
  std::uint32_t number_ = 0;
  double signed_s_ = 0.0;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
