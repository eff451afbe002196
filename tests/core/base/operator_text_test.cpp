#include "core/base/operator_text.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

struct OperatorTextTest : testing::Test {
  ~OperatorTextTest() override { SetTranslator(nullptr); }
};

std::string ToGerman(const char* english) {
  const std::string text = english;
  if (text == "none") return "keine";
  if (text == "{} of {} points") return "von {1} Punkten {0}";
  if (text == "{} edges") return "{} {} {oops";
  return text;
}

TEST_F(OperatorTextTest, IsEnglishWithoutATranslator) {
  EXPECT_EQ(OperatorText("none"), "none");
  EXPECT_EQ(OperatorText("{} of {} points", 2, 3), "2 of 3 points");
}

TEST_F(OperatorTextTest, IsTranslatedWithItsValuesInTheirPlaces) {
  SetTranslator(ToGerman);
  EXPECT_EQ(OperatorText("none"), "keine");
  EXPECT_EQ(OperatorText("{} of {} points", 2, 3), "von 3 Punkten 2");
}

TEST_F(OperatorTextTest, ATranslationThatDoesNotFitIsLeftOut) {
  SetTranslator(ToGerman);
  EXPECT_EQ(OperatorText("{} edges", 4), "4 edges");
}

}  // namespace
}  // namespace foresight
