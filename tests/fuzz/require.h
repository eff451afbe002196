#pragma once

#include <cstdio>
#include <cstdlib>

namespace foresight {

/// A promise that must hold for every input; libFuzzer keeps the input that breaks it.
inline void Require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace foresight
