#include "core/base/memory.h"

#include <malloc.h>

#include <cstddef>

// Here only where the program is linked with jemalloc.
extern "C" [[gnu::weak]] int mallctl(const char* name, void* old, std::size_t* old_size, void* set,
                                     std::size_t set_size);

namespace foresight {

void GiveMemoryBack() {
  // 4096 is MALLCTL_ARENAS_ALL.
  if (mallctl != nullptr)
    mallctl("arena.4096.purge", nullptr, nullptr, nullptr, 0);
  else
    malloc_trim(0);
}

void KeepFewArenas() {
  constexpr int kArenas = 2;
  mallopt(M_ARENA_MAX, kArenas);
}

}  // namespace foresight
