#include "core/base/parallel.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace foresight {

int ThreadCount(const RunContext& context) {
  if (context.threads > 0) return context.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

bool ParallelFor(int count, const RunContext& context, const std::function<void(int)>& body) {
  const int threads = std::min(ThreadCount(context), std::max(1, count));
  std::atomic<int> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      while (!failed.load(std::memory_order_relaxed) && !context.Cancelled()) {
        const int i = next.fetch_add(1, std::memory_order_relaxed);
        if (i >= count) return;
        body(i);
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      failed = true;
    }
  };
  if (threads == 1) {
    work();
  } else {
    // TBB's threads are made once in the program. Where none is free, this one does it all.
    tbb::task_arena(threads).execute([&] {
      tbb::task_group helpers;
      for (int t = 1; t < threads; ++t) helpers.run(work);
      work();
      helpers.wait();
    });
  }
  if (failure) std::rethrow_exception(failure);
  return !context.Cancelled();
}

}  // namespace foresight
