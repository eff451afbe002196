#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/vector_targets.h"

namespace foresight {

/// Runs a test on every instruction set: instantiate with testing::ValuesIn(VectorTargets()) and
/// VectorTargetName.
class OnEveryVectorTarget : public testing::TestWithParam<int64_t> {
 private:
  OnlyVectorTarget only_{GetParam()};
};

inline std::string VectorTargetName(const testing::TestParamInfo<int64_t>& info) {
  return hwy::TargetName(info.param);
}

}  // namespace foresight
