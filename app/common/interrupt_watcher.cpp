#include "app/common/interrupt_watcher.h"

#include <atomic>
#include <chrono>
#include <csignal>

namespace foresight {
namespace {

std::atomic<int> g_signal{0};  ///< the first one; 0 = none

void RememberSignal(int signal) {
  int none = 0;
  g_signal.compare_exchange_strong(none, signal);
}

}  // namespace

std::string InterruptReason() {
  const int signal = g_signal;
  if (signal == 0) return "";
  return signal == SIGTERM ? "the program was told to end (SIGTERM)"
                           : "the program was told to end (SIGINT, Ctrl-C)";
}

InterruptWatcher::InterruptWatcher(std::stop_source& source) {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, RememberSignal);
  thread_ = std::jthread([&source](const std::stop_token& ended) {
    while (!ended.stop_requested()) {
      if (g_signal != 0) source.request_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
}

}  // namespace foresight
