#include "hardware/api/head_link.h"

namespace foresight {

const char* ToString(LinkedScan::Place place) {
  constexpr const char* kNames[] = {"at the head", "waiting", "coming", "paused", "here"};
  return kNames[static_cast<std::size_t>(place)];
}

}  // namespace foresight
