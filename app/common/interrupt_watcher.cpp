#include "app/common/interrupt_watcher.h"

#include <atomic>
#include <chrono>
#include <csignal>

namespace foresight {
namespace {

std::atomic<bool> g_interrupted{false};

}  // namespace

InterruptWatcher::InterruptWatcher(std::stop_source& source) {
  std::signal(SIGINT, [](int) { g_interrupted = true; });
  std::signal(SIGTERM, [](int) { g_interrupted = true; });
  thread_ = std::jthread([&source](const std::stop_token& ended) {
    while (!ended.stop_requested()) {
      if (g_interrupted) source.request_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
}

}  // namespace foresight
