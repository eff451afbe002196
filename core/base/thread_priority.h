#pragma once

#include <sys/resource.h>

namespace foresight {

/// The calling thread works on what can wait: others of this computer go before it. Where the
/// system refuses, the thread goes on as it was.
inline void LetOthersGoFirst() {
  constexpr int kNice = 10;
  setpriority(PRIO_PROCESS, 0, kNice);  // on Linux of the thread alone
}

}  // namespace foresight
