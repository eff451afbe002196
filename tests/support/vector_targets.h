#pragma once

#include <hwy/targets.h>

#include <vector>

namespace foresight {

/// The instruction sets that this processor has and the kernels are compiled for, widest first.
inline std::vector<int64_t> VectorTargets() {
  std::vector<int64_t> targets;
  for (const int64_t target : {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_SCALAR})
    if (target == HWY_SCALAR || (hwy::SupportedTargets() & target) != 0) targets.push_back(target);
  return targets;
}

/// Makes the kernels run on one instruction set as long as it lives.
class OnlyVectorTarget {
 public:
  explicit OnlyVectorTarget(int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
  }
  ~OnlyVectorTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnlyVectorTarget(const OnlyVectorTarget&) = delete;
  OnlyVectorTarget& operator=(const OnlyVectorTarget&) = delete;
};

}  // namespace foresight
