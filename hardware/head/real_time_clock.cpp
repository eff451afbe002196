#include "hardware/head/real_time_clock.h"

#include <thread>

namespace foresight {

double RealTimeClock::Now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void RealTimeClock::Sleep(std::chrono::microseconds duration) {
  std::this_thread::sleep_for(duration);
}

}  // namespace foresight
