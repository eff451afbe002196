#include "hardware/link/client/channel_race.h"

#include <grpcpp/channel.h>

#include "core/base/contract.h"

namespace foresight {
namespace {

/// How late a channel that rests sees that the one in use broke.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

ChannelRace::ChannelRace(std::vector<std::shared_ptr<grpc::Channel>> channels)
    : channels_(std::move(channels)), connected_(channels_.size()) {
  FORESIGHT_EXPECTS(!channels_.empty(), "a race has one channel at least");
  for (std::size_t i = 0; i < channels_.size(); ++i)
    watchers_.emplace_back([this, i](const std::stop_token& stop) { Watch(i, stop); });
}

ChannelRace::~ChannelRace() {
  for (std::jthread& watcher : watchers_) watcher.request_stop();
}

std::size_t ChannelRace::Current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

bool ChannelRace::Connected() const {
  const std::lock_guard lock(mutex_);
  return connected_[current_];
}

bool ChannelRace::Wait(std::chrono::system_clock::time_point deadline) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, deadline, [this] { return connected_[current_]; });
}

bool ChannelRace::Wait(const std::stop_token& stop) const {
  std::unique_lock lock(mutex_);
  return changed_.wait(lock, stop, [this] { return connected_[current_]; });
}

bool ChannelRace::MayConnect(std::size_t channel) const {
  const std::lock_guard lock(mutex_);
  return channel == current_ || !connected_[current_];
}

void ChannelRace::Told(std::size_t channel, bool connected) {
  const std::lock_guard lock(mutex_);
  connected_[channel] = connected;
  for (std::size_t i = 0; !connected_[current_] && i < connected_.size(); ++i)
    if (connected_[i]) current_ = i;
  changed_.notify_all();
}

/// gRPC moves a connection on only while somebody waits for it: that is what this thread is for.
void ChannelRace::Watch(std::size_t channel, const std::stop_token& stop) {
  grpc::Channel& watched = *channels_[channel];
  while (!stop.stop_requested()) {
    const grpc_connectivity_state state = watched.GetState(MayConnect(channel));
    Told(channel, state == GRPC_CHANNEL_READY);
    watched.WaitForStateChange(state, std::chrono::system_clock::now() + kLook);
  }
}

}  // namespace foresight
