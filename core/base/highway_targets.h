#pragma once

// To be read before Highway's own headers, in every file that is compiled once per instruction set:
// the sets that are left out. Wider than AVX-512 there is nothing to gain from; scalable registers
// cannot be kept in structs.
#define HWY_DISABLED_TARGETS \
  (HWY_AVX3_DL | HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
