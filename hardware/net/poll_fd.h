#pragma once

#include <poll.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "hardware/net/wake_up.h"

namespace foresight {

/// Waits until `fd` is ready for `events`, has failed, was woken up, or `timeout` is over; returns
/// whether `fd` is ready or has failed. Ends early when a signal comes. Resolution: the system's,
/// not poll()'s millisecond.
inline bool PollFd(int fd, short events, std::chrono::microseconds timeout, const WakeUp* wake) {
  std::array<pollfd, 2> waiting{{{fd, events, 0}, {wake ? wake->fd() : -1, POLLIN, 0}}};
  const auto us = std::max<std::int64_t>(0, timeout.count());
  const timespec span{us / 1'000'000, us % 1'000'000 * 1000};
  return ::ppoll(waiting.data(), waiting.size(), &span, nullptr) > 0 && waiting[0].revents != 0;
}

}  // namespace foresight
