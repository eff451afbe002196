#include "core/options/option.h"

#include <gmock/gmock.h>

#include "core/options/option_json.h"
#include "core/options/option_text.h"

namespace foresight {
namespace {

using testing::HasSubstr;

OptionInfo Millimetres() {
  return {.key = "threshold_m",
          .type = OptionType::kNumber,
          .unit = "mm",
          .units_per_si = 1000.0,
          .low = 0.0,
          .high = 500.0};
}

OptionInfo Seed() {
  return {.key = "seed", .type = OptionType::kSeed};
}

TEST(OptionText, ANumberIsTypedInItsUnitAndReadToTheLastBit) {
  EXPECT_EQ(std::get<double>(*OptionFromText(Millimetres(), "30")), 0.030);
  for (const double value : {0.030, 1.0 / 3.0, 0.1 + 0.2, 5e-324, 0.018})
    EXPECT_EQ(std::get<double>(*OptionFromText(Millimetres(), OptionText(Millimetres(), value))),
              value);
  EXPECT_EQ(OptionText(Millimetres(), 0.030), "30");
}

TEST(OptionText, WhatIsNoValueIsRefusedWithWhatIsExpected) {
  for (const char* text : {"", "x", "30 mm", "nan", "inf", "1e999", "1,2"})
    EXPECT_FALSE(OptionFromText(Millimetres(), text)) << text;
  EXPECT_THAT(OptionFromText(Seed(), "-1").error().message, HasSubstr("from 0 to 1844674407"));
  EXPECT_EQ(std::get<std::uint64_t>(*OptionFromText(Seed(), "18446744073709551615")),
            18446744073709551615u);
  const OptionInfo pair{.key = "size", .type = OptionType::kNumbers, .count = 2};
  for (const char* text : {"1", "1,2,3", "1,", ",", "1,x"})
    EXPECT_FALSE(OptionFromText(pair, text)) << text;
}

TEST(CheckOption, NamesTheOptionTheValueAndTheRangeInItsUnit) {
  EXPECT_TRUE(CheckOption(Millimetres(), 0.5));
  const Status status = CheckOption(Millimetres(), 0.6);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "threshold_m is 600; it must be from 0 to 500 mm");
  EXPECT_FALSE(CheckOption(Millimetres(), OptionValue(true)));
  EXPECT_FALSE(CheckOption(Millimetres(), std::nan("")));
}

TEST(OptionsJson, AnUnknownKeyAndAWrongTypeAreNamed) {
  const auto find = [](const std::string& key) -> const OptionInfo* {
    static const OptionInfo info = Millimetres();
    return key == info.key ? &info : nullptr;
  };
  EXPECT_THAT(KeyedValuesFromJson(R"({"treshold":1})", find).error().message,
              HasSubstr("option treshold is not known"));
  EXPECT_THAT(KeyedValuesFromJson(R"({"threshold_m":"x"})", find).error().message,
              HasSubstr("threshold_m"));
  EXPECT_THAT(KeyedValuesFromJson(R"({"threshold_m":9})", find).error().message,
              HasSubstr("9000; it must be"));
  EXPECT_FALSE(KeyedValuesFromJson("[]", find));
  EXPECT_FALSE(KeyedValuesFromJson("", find));
}

}  // namespace
}  // namespace foresight
