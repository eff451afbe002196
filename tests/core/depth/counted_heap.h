#pragma once

#include <cstddef>

namespace foresight {

/// Bytes that malloc and its kin hold at this moment, in all threads, with the allocator's own
/// rounding.
std::size_t HeapBytes();

/// The most that HeapBytes was since the last ForgetHeapPeak.
std::size_t HeapPeakBytes();
void ForgetHeapPeak();

}  // namespace foresight
