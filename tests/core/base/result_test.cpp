#include "core/base/result.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

Result<int> Half(int number) {
  if (number % 2 != 0) return Fail(ErrorCode::kInvalidInput, "{} is odd", number);
  return number / 2;
}

Result<int> Quarter(int number) {
  FORESIGHT_TRY(const int half, Half(number));
  return Half(half);
}

TEST(Result, TryPassesAnErrorOnUnchanged) {
  const auto result = Quarter(3);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(result.error().message, "3 is odd");
}

TEST(Result, TryUnwrapsAValue) {
  EXPECT_EQ(Quarter(8).value(), 2);
}

TEST(Result, CheckPassesAnErrorOnUnchanged) {
  const auto check = [](Status status) -> Status {
    FORESIGHT_CHECK(status);
    return {};
  };
  EXPECT_TRUE(check({}));
  EXPECT_EQ(check(Fail(ErrorCode::kIo, "disk full")).error().message, "disk full");
}

}  // namespace
}  // namespace foresight
