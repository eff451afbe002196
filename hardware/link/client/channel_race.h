#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "hardware/link/wire/station_channels.h"

namespace foresight {

/// Channels to one head: many whose attempts to connect are short find a window that opens within a
/// few hundredths of a second, others with longer ones get through where a round trip takes long.
/// While none is connected all of them try; the first one that is connected is used until it
/// breaks. What the others have begun by then is given up at once, because eight handshakes take
/// from the window what one is to find. Safe from any thread.
class ChannelRace {
 public:
  /// @pre one channel at least
  explicit ChannelRace(std::vector<ChannelMaker> makers);
  ~ChannelRace();
  ChannelRace(const ChannelRace&) = delete;
  ChannelRace& operator=(const ChannelRace&) = delete;

  /// The channel that is connected or, where none is, was last.
  std::shared_ptr<grpc::Channel> Current() const;
  bool Connected() const;
  /// Nothing comes on the current channel though something should. TCP would find out by sending
  /// again, later and later, and might sleep through half of a window: the others may connect, and
  /// the first that does is used, unless Trust() is called before. Calls that run stay where they
  /// are.
  void Doubt();
  void Trust();
  /// Returns Connected(), after `deadline` at the latest.
  bool Wait(std::chrono::system_clock::time_point deadline) const;
  /// The same without an end but `stop`'s.
  bool Wait(const std::stop_token& stop) const;

 private:
  struct Lane {
    std::shared_ptr<grpc::Channel> channel;
    int renewed = 0;  ///< how often
    bool connected = false;
  };
  using Channels = std::vector<std::shared_ptr<grpc::Channel>>;

  void Watch(const std::stop_token& stop);
  Lane Get(std::size_t lane) const;
  bool MayConnect(std::size_t lane) const;
  void Told(std::size_t lane, int renewed, bool connected);
  void Renew(std::size_t lane, Channels& old);

  const std::vector<ChannelMaker> makers_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::vector<Lane> lanes_;
  std::size_t current_ = 0;
  bool doubted_ = false;  ///< the current one
  std::jthread watcher_;
};

}  // namespace foresight
