// Takes the place of malloc and its kin for the whole program, libraries included: operator new,
// OpenCV's and Highway's allocators all end here. glibc's own ones do the work.
#include "tests/core/depth/counted_heap.h"

#include <malloc.h>

#include <atomic>
#include <cerrno>

namespace {

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> peak{0};

void* Counted(void* block) {
  if (block == nullptr) return nullptr;
  const std::size_t size = malloc_usable_size(block);
  const std::size_t now = held.fetch_add(size) + size;
  std::size_t highest = peak.load();
  while (now > highest && !peak.compare_exchange_weak(highest, now)) {
  }
  return block;
}

void Uncount(void* block) {
  if (block != nullptr) held.fetch_sub(malloc_usable_size(block));
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  return Counted(__libc_malloc(size));
}

void* calloc(std::size_t count, std::size_t size) {
  return Counted(__libc_calloc(count, size));
}

void* realloc(void* block, std::size_t size) {
  const std::size_t before = block != nullptr ? malloc_usable_size(block) : 0;
  void* moved = __libc_realloc(block, size);
  if (moved != nullptr || size == 0) held.fetch_sub(before);  // else the old block stays
  return Counted(moved);
}

void* memalign(std::size_t alignment, std::size_t size) {
  return Counted(__libc_memalign(alignment, size));
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return Counted(__libc_memalign(alignment, size));
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  void* made = Counted(__libc_memalign(alignment, size));
  if (made == nullptr) return ENOMEM;
  *block = made;
  return 0;
}

void free(void* block) {
  Uncount(block);
  __libc_free(block);
}

}  // extern "C"

namespace foresight {

std::size_t HeapBytes() {
  return held.load();
}

std::size_t HeapPeakBytes() {
  return peak.load();
}

void ForgetHeapPeak() {
  peak.store(held.load());
}

}  // namespace foresight
