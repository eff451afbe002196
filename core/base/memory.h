#pragma once

#include <malloc.h>

namespace foresight {

/// What was freed goes back to the system: after a scan, that is its lines and images.
inline void GiveMemoryBack() {
  malloc_trim(0);
}

/// For a program of many threads that lives for days, called before they start: each of glibc's
/// arenas (8 a core by itself) keeps the most that its threads ever had.
inline void KeepFewArenas() {
  constexpr int kArenas = 2;
  mallopt(M_ARENA_MAX, kArenas);
}

}  // namespace foresight
