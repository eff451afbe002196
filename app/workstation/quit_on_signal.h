#pragma once

#include <QSocketNotifier>
#include <functional>
#include <memory>

namespace foresight {

/// Turns SIGTERM and SIGINT into an orderly end of the event loop: `before` runs in the GUI thread,
/// then the application quits. Only one at a time; the signals are as before when it goes.
class QuitOnSignal {
 public:
  explicit QuitOnSignal(std::function<void()> before);
  ~QuitOnSignal();
  QuitOnSignal(const QuitOnSignal&) = delete;
  QuitOnSignal& operator=(const QuitOnSignal&) = delete;

 private:
  std::function<void()> before_;
  std::unique_ptr<QSocketNotifier> notifier_;
};

}  // namespace foresight
