#include "hardware/link/client/channel_race.h"

#include <grpcpp/channel.h>
#include <grpcpp/completion_queue.h>

#include "core/base/contract.h"

namespace foresight {
namespace {

/// How late a channel that rests sees that the one in use broke.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

ChannelRace::ChannelRace(std::vector<std::shared_ptr<grpc::Channel>> channels)
    : channels_(std::move(channels)), connected_(channels_.size()) {
  FORESIGHT_EXPECTS(!channels_.empty(), "a race has one channel at least");
  watcher_ = std::jthread([this](const std::stop_token& stop) { Watch(stop); });
}

ChannelRace::~ChannelRace() = default;

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
void ChannelRace::Watch(const std::stop_token& stop) {
  grpc::CompletionQueue changes;
  std::vector<char> tags(channels_.size());  // a tag is an address
  const auto look = [&](std::size_t channel) {
    grpc::Channel& watched = *channels_[channel];
    const grpc_connectivity_state state = watched.GetState(MayConnect(channel));
    Told(channel, state == GRPC_CHANNEL_READY);
    watched.NotifyOnStateChange(state, std::chrono::system_clock::now() + kLook, &changes,
                                &tags[channel]);
  };
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) look(channel);
  std::size_t watched = channels_.size();
  void* tag = nullptr;
  bool changed = false;
  while (watched > 0 && changes.Next(&tag, &changed)) {
    if (stop.stop_requested())
      --watched;
    else
      look(static_cast<std::size_t>(static_cast<char*>(tag) - tags.data()));
  }
  changes.Shutdown();
  while (changes.Next(&tag, &changed)) continue;
}

}  // namespace foresight
