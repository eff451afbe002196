#include "core/base/shared_array.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>

namespace foresight {
namespace {

SharedArray<int> Numbers(int count) {
  SharedArray<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

TEST(SharedArray, HoldsWhatWasAppended) {
  const SharedArray<int> numbers = Numbers(1000);
  ASSERT_EQ(numbers.size(), 1000u);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(numbers[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(numbers.front(), 0);
  EXPECT_EQ(numbers.back(), 999);
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0), 499'500);
  EXPECT_TRUE(SharedArray<int>().empty());
}

TEST(SharedArray, ACopySharesItsValuesAndDoesNotGrowWithTheOriginal) {
  SharedArray<int> numbers = Numbers(20);
  const SharedArray<int> copy = numbers;
  EXPECT_EQ(copy.data(), numbers.data());
  numbers.push_back(20);
  EXPECT_EQ(copy.data(), numbers.data()) << "there was room behind them";
  EXPECT_EQ(copy.size(), 20u);
  EXPECT_EQ(copy, Numbers(20));
  EXPECT_EQ(numbers, Numbers(21));
}

TEST(SharedArray, TwoCopiesThatBothGrowPart) {
  SharedArray<int> one = Numbers(20);
  SharedArray<int> other = one;
  one.push_back(1);
  other.push_back(2);
  EXPECT_EQ(one.back(), 1);
  EXPECT_EQ(other.back(), 2);
  EXPECT_NE(one.data(), other.data());
}

TEST(SharedArray, OneThatWasShortenedDoesNotWriteIntoItsCopies) {
  SharedArray<int> numbers = Numbers(20);
  const SharedArray<int> copy = numbers;
  numbers.Truncate(5);
  numbers.push_back(77);
  EXPECT_EQ(copy, Numbers(20));
  EXPECT_EQ(numbers.size(), 6u);
  EXPECT_EQ(numbers.back(), 77);
}

TEST(SharedArray, CopiesMayBeReadWhileTheOriginalGrows) {
  SharedArray<int> numbers;
  std::jthread reader;
  for (int i = 0; i < 20'000; ++i) {
    numbers.push_back(i);
    if (i % 5000 != 4999) continue;
    reader = std::jthread([copy = numbers] {
      int wrong = 0;
      for (std::size_t k = 0; k < copy.size(); ++k) wrong += copy[k] != static_cast<int>(k);
      EXPECT_EQ(wrong, 0);
    });
  }
}

}  // namespace
}  // namespace foresight
