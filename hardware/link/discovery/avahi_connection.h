#pragma once

#include <avahi-client/client.h>
#include <avahi-common/thread-watch.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace foresight {

/// A connection to this computer's Avahi daemon, made again when the daemon comes back. Callbacks
/// run in a thread of its own.
class AvahiConnection {
 public:
  /// The client is there and its daemon answers: make what hangs on it. It goes with the client.
  using Ready = std::function<void(AvahiClient*)>;
  /// Forget what hung on the client; it is freed next.
  using Gone = std::function<void()>;

  AvahiConnection(Ready ready, Gone gone);
  /// After it no callback runs.
  ~AvahiConnection();
  AvahiConnection(const AvahiConnection&) = delete;
  AvahiConnection& operator=(const AvahiConnection&) = delete;

  /// Begins; separate, so that the callbacks find their owner whole.
  void Start();

  /// Why nothing works now: "no mDNS on this computer: ..."; empty when the daemon answers. Safe
  /// from any thread.
  std::string Trouble() const;

 private:
  struct FreePoll {
    void operator()(AvahiThreadedPoll* poll) const { avahi_threaded_poll_free(poll); }
  };

  static void OnState(AvahiClient* client, AvahiClientState state, void* self);
  static void OnRetry(AvahiTimeout* timeout, void* self);
  void Connect();
  void RetryLater();
  void SetTrouble(std::string trouble);

  const Ready ready_;
  const Gone gone_;
  std::unique_ptr<AvahiThreadedPoll, FreePoll> poll_;
  AvahiClient* client_ = nullptr;  ///< of poll_'s thread
  AvahiTimeout* retry_ = nullptr;  ///< the same
  mutable std::mutex mutex_;
  std::string trouble_;  ///< by mutex_
};

}  // namespace foresight
