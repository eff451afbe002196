#pragma once

#include <functional>

#include "core/base/run_context.h"

namespace foresight {

/// Number of worker threads that `context` allows on this machine, at least 1.
int ThreadCount(const RunContext& context);

/// Calls body(i) for every i in [0, count), on ThreadCount(context) threads, in no order. Stops
/// handing out work when the context is cancelled; returns false then. An exception in body reaches
/// the caller.
bool ParallelFor(int count, const RunContext& context, const std::function<void(int)>& body);

}  // namespace foresight
