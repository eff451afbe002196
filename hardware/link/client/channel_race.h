#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace grpc {
class Channel;
}

namespace foresight {

/// Channels to one head: many whose attempts to connect are short find a window that opens within a
/// few hundredths of a second, others with longer ones get through where a round trip takes long.
/// While none is connected all of them try; the first one that is connected is used until it
/// breaks, and the others rest. Safe from any thread.
class ChannelRace {
 public:
  /// @pre one channel at least
  explicit ChannelRace(std::vector<std::shared_ptr<grpc::Channel>> channels);
  ~ChannelRace();
  ChannelRace(const ChannelRace&) = delete;
  ChannelRace& operator=(const ChannelRace&) = delete;

  /// The channel that is connected or, where none is, was last.
  std::size_t Current() const;
  bool Connected() const;
  /// Returns Connected(), after `deadline` at the latest.
  bool Wait(std::chrono::system_clock::time_point deadline) const;
  /// The same without an end but `stop`'s.
  bool Wait(const std::stop_token& stop) const;

 private:
  void Watch(const std::stop_token& stop);
  bool MayConnect(std::size_t channel) const;
  void Told(std::size_t channel, bool connected);

  const std::vector<std::shared_ptr<grpc::Channel>> channels_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::size_t current_ = 0;
  std::vector<bool> connected_;
  std::jthread watcher_;
};

}  // namespace foresight
