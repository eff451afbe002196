#include "core/io/json_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace foresight {
namespace {

using testing::HasSubstr;

/// What the reader says of {"n": text}.
template <class Read>
std::string FaultOf(const std::string& text, const Read& read) {
  const nlohmann::json object = nlohmann::json::parse("{\"n\": " + text + "}");
  try {
    read(object);
  } catch (const std::exception& fault) {
    return fault.what();
  }
  return "none";
}

std::string IntegerFault(const std::string& text) {
  return FaultOf(text, [](const auto& object) { IntegerIn(object, "n", 0, 6); });
}

TEST(JsonReader, AWholeNumberWithinItsRangeIsRead) {
  EXPECT_EQ(IntegerIn({{"n", 6}}, "n", 0, 6), 6);
  EXPECT_EQ(IntegerIn({{"n", -3}}, "n", -3, -1), -3);
}

TEST(JsonReader, WhatIsNoWholeNumberOfTheRangeIsNamed) {
  EXPECT_EQ(IntegerFault("1000000000"), "'n' is 1000000000, not a whole number from 0 to 6");
  for (const char* text :
       {"-1", "7", "4294967297", "18446744073709551615", "3.0", "1e300", "null", "\"3\"", "[3]"})
    EXPECT_THAT(IntegerFault(text), HasSubstr("not a whole number from 0 to 6")) << text;
}

TEST(JsonReader, ANumberOutsideItsRangeIsNamed) {
  const auto read = [](const auto& object) { NumberIn(object, "n", 0.0, 10.0); };
  EXPECT_EQ(FaultOf("9.5", read), "none");
  EXPECT_EQ(FaultOf("1e308", read), "'n' is 1e+308, not 0 to 10");
  EXPECT_EQ(FaultOf("null", read), "'n' is null, not a number");
}

TEST(JsonReader, AListOfTooManyIsRefused) {
  const auto read = [](const auto& object) { ListIn(object, "n", 2); };
  EXPECT_EQ(FaultOf("[1, 2]", read), "none");
  EXPECT_EQ(FaultOf("[1, 2, 3]", read), "'n' has 3 entries, more than 2");
  EXPECT_EQ(FaultOf("7", read), "'n' is 7, not a list");
}

TEST(JsonReader, ListsInListsEndSomewhere) {
  const auto nested = [](int levels) {
    return std::string(static_cast<std::size_t>(levels), '[') +
           std::string(static_cast<std::size_t>(levels), ']');
  };
  EXPECT_NO_THROW(ParseJson(nested(kMostJsonLevels)));
  EXPECT_THROW(ParseJson(nested(kMostJsonLevels + 1)), std::invalid_argument);
  EXPECT_THROW(ParseJson(std::string(1'000'000, '[')), std::invalid_argument);
}

}  // namespace
}  // namespace foresight
