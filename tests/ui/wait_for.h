#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <functional>

#include "tests/support/sanitized.h"

namespace foresight {

/// Runs the event loop until `condition` holds; false when it does not within `limit_ms`, or ten
/// times that under a sanitizer.
inline bool WaitFor(const std::function<bool()>& condition, int limit_ms = 60'000) {
  QElapsedTimer timer;
  timer.start();
  // With a time limit of its own processEvents never sleeps, and takes a core from what is waited
  // for.
  QTimer wake;
  wake.start(20);
  while (!condition()) {
    if (static_cast<double>(timer.elapsed()) > kSanitizerFactor * limit_ms) return false;
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents | QEventLoop::AllEvents);
  }
  return true;
}

}  // namespace foresight
