#include "core/base/shared_list.h"

#include <gtest/gtest.h>

#include <string>

namespace foresight {
namespace {

TEST(SharedList, IsReadLikeAVector) {
  const SharedList<std::string> words(std::vector<std::string>{"one", "two", "three"});
  ASSERT_EQ(words.size(), 3u);
  EXPECT_EQ(words[1], "two");
  EXPECT_EQ(words.front() + words.back(), "onethree");
  std::string all;
  for (const std::string& word : words) all += word;
  EXPECT_EQ(all, "onetwothree");
  EXPECT_EQ(std::find(words.begin(), words.end(), "three") - words.begin(), 2);
}

TEST(SharedList, ACopySharesTheValuesThemselves) {
  SharedList<std::string> words({"one", "two"});
  const SharedList<std::string> copy = words;
  words.push_back("three");
  EXPECT_EQ(&copy[0], &words[0]);
  EXPECT_EQ(copy.size(), 2u);
  EXPECT_EQ(words.size(), 3u);
}

TEST(SharedList, AnEditedValueIsThisListsAlone) {
  SharedList<std::string> words({"one", "two"});
  const SharedList<std::string> copy = words;
  words.Edit(1) = "deux";
  EXPECT_EQ(words[1], "deux");
  EXPECT_EQ(copy[1], "two");
  EXPECT_EQ(&copy[0], &words[0]);
  EXPECT_FALSE(copy == words);
}

}  // namespace
}  // namespace foresight
