#include "hardware/link/client/channel_race.h"

#include <grpcpp/channel.h>
#include <grpcpp/completion_queue.h>

#include "core/base/contract.h"

namespace foresight {
namespace {

/// How late a channel that rests sees that the one in use broke.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

ChannelRace::ChannelRace(std::vector<ChannelMaker> makers) : makers_(std::move(makers)) {
  FORESIGHT_EXPECTS(!makers_.empty(), "a race has one channel at least");
  for (const ChannelMaker& make : makers_) lanes_.push_back({make()});
  watcher_ = std::jthread([this](const std::stop_token& stop) { Watch(stop); });
}

ChannelRace::~ChannelRace() = default;

std::shared_ptr<grpc::Channel> ChannelRace::Current() const {
  const std::lock_guard lock(mutex_);
  return lanes_[current_].channel;
}

bool ChannelRace::Connected() const {
  const std::lock_guard lock(mutex_);
  return lanes_[current_].connected;
}

void ChannelRace::Doubt() {
  const std::lock_guard lock(mutex_);
  doubted_ = true;
}

void ChannelRace::Trust() {
  const std::lock_guard lock(mutex_);
  doubted_ = false;
}

bool ChannelRace::Wait(std::chrono::system_clock::time_point deadline) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, deadline, [this] { return lanes_[current_].connected; });
}

bool ChannelRace::Wait(const std::stop_token& stop) const {
  std::unique_lock lock(mutex_);
  return changed_.wait(lock, stop, [this] { return lanes_[current_].connected; });
}

ChannelRace::Lane ChannelRace::Get(std::size_t lane) const {
  const std::lock_guard lock(mutex_);
  return lanes_[lane];
}

bool ChannelRace::MayConnect(std::size_t lane) const {
  const std::lock_guard lock(mutex_);
  return lane == current_ || doubted_ || !lanes_[current_].connected;
}

void ChannelRace::Told(std::size_t lane, int renewed, bool connected) {
  Channels old;  // goes after the lock
  const std::lock_guard lock(mutex_);
  if (lanes_[lane].renewed != renewed) return;
  const bool fresh = connected && !lanes_[lane].connected;
  lanes_[lane].connected = connected;
  if (fresh && (doubted_ || !lanes_[current_].connected)) current_ = lane;
  if (fresh && lane == current_) {
    doubted_ = false;
    for (std::size_t other = 0; other < lanes_.size(); ++other)
      if (other != lane && lanes_[other].channel->GetState(false) != GRPC_CHANNEL_IDLE)
        Renew(other, old);
  } else if (connected && lane != current_) {
    Renew(lane, old);  // it came too late
  }
  changed_.notify_all();
}

/// gRPC has no other way to end an attempt than to let go of its channel.
void ChannelRace::Renew(std::size_t lane, Channels& old) {
  old.push_back(std::move(lanes_[lane].channel));
  lanes_[lane] = {makers_[lane](), lanes_[lane].renewed + 1};
}

/// gRPC moves a connection on only while somebody waits for it: that is what this thread is for.
void ChannelRace::Watch(const std::stop_token& stop) {
  struct Look {
    std::size_t lane;
  };
  grpc::CompletionQueue changes;
  std::vector<Look> looks(makers_.size());  // a tag is an address; each lane has one under way
  const auto look = [&](std::size_t lane) {
    looks[lane].lane = lane;
    const Lane watched = Get(lane);
    const grpc_connectivity_state state = watched.channel->GetState(MayConnect(lane));
    Told(lane, watched.renewed, state == GRPC_CHANNEL_READY);
    watched.channel->NotifyOnStateChange(state, std::chrono::system_clock::now() + kLook, &changes,
                                         &looks[lane]);
  };
  for (std::size_t lane = 0; lane < looks.size(); ++lane) look(lane);
  std::size_t watched = looks.size();
  void* tag = nullptr;
  bool changed = false;
  while (watched > 0 && changes.Next(&tag, &changed)) {
    if (stop.stop_requested())
      --watched;
    else
      look(static_cast<const Look*>(tag)->lane);
  }
  changes.Shutdown();
  while (changes.Next(&tag, &changed)) continue;
}

}  // namespace foresight
