#include "core/depth/depth_option_table.h"

#include <gmock/gmock.h>

#include <set>

#include "core/depth/depth_method.h"
#include "core/options/option_json.h"

namespace foresight {
namespace {

/// Another value that the option takes.
OptionValue Other(const OptionInfo& info, const OptionValue& value) {
  switch (info.type) {
    case OptionType::kSwitch:
      return !std::get<bool>(value);
    case OptionType::kInteger: {
      const auto now = std::get<std::int64_t>(value);
      return static_cast<double>(now) + 1.0 <= info.high ? now + 1 : now - 1;
    }
    case OptionType::kNumber: {
      const double now = std::get<double>(value);
      const double more = now == 0.0 ? 1.0 / info.units_per_si : 1.0625 * now;
      return more * info.units_per_si <= info.high ? more : 0.9375 * now;
    }
    case OptionType::kChoice:
      return std::get<std::string>(value) == info.words[0] ? info.words[1] : info.words[0];
    default:
      return value;
  }
}

TEST(DepthOptionTable, EveryOptionSurvivesJsonWithEveryMethod) {
  for (const DepthMethodInfo& method : DepthMethods())
    for (const Option<DepthOptions>& option : DepthOptionTable()) {
      DepthOptions options = DefaultsOf(method.method);
      if (!option.AppliesTo(options)) continue;
      const OptionValue before = option.get(options);
      ASSERT_TRUE(SetOption(option, options, Other(option.info, before)))
          << method.name << " " << option.info.key;
      EXPECT_NE(option.get(options), before) << method.name << " " << option.info.key;
      if (!options.Check()) continue;  // guided passes need a pass
      const auto read = DepthOptionsFromJson(DepthOptionsToJson(options));
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(DepthOptionsToJson(*read), DepthOptionsToJson(options))
          << method.name << " " << option.info.key;
      EXPECT_EQ(option.get(*read), option.get(options)) << method.name << " " << option.info.key;
    }
}

TEST(DepthOptionTable, DefaultsComeBackBitForBit) {
  for (const DepthMethodInfo& method : DepthMethods()) {
    const DepthOptions usual = DefaultsOf(method.method);
    const auto read = DepthOptionsFromJson(DepthOptionsToJson(usual));
    ASSERT_TRUE(read) << read.error().message;
    for (const Option<DepthOptions>& option : DepthOptionTable())
      EXPECT_EQ(option.get(*read), option.get(usual)) << method.name << " " << option.info.key;
  }
}

TEST(DepthOptionTable, EachFlyingRuleBringsWhatBelongsToIt) {
  const Option<DepthOptions>* rule = FindOption(DepthOptionTable(), "flying.rule");
  ASSERT_NE(rule, nullptr);
  DepthOptions options;
  ASSERT_TRUE(SetOption(*rule, options, std::string("adaptive")));
  EXPECT_EQ(options.flying.distance, FlyingPointOptions::Distance::kDepth);
  EXPECT_EQ(options.flying.threshold_per_step, 2.0);
  ASSERT_TRUE(SetOption(*rule, options, std::string("min")));
  EXPECT_EQ(options.flying.rule, FlyingPointOptions::Rule::kBothNeighboursFar);
  EXPECT_EQ(options.flying.distance, FlyingPointOptions::Distance::kEuclidean);
}

TEST(DepthOptionTable, KeysAreUniqueAndEveryOptionHasAFlagAndAText) {
  std::set<std::string> keys;
  for (const Option<DepthOptions>& option : DepthOptionTable()) {
    EXPECT_TRUE(keys.insert(option.info.key).second) << option.info.key;
    EXPECT_TRUE(option.info.flag.starts_with("--")) << option.info.key;
    EXPECT_FALSE(option.info.title.empty() || option.info.help.empty() || option.info.group.empty())
        << option.info.key;
  }
}

// Who adds a member to an options struct meets this: it belongs into the table too.
TEST(DepthOptionTable, KnowsAllMembers) {
  EXPECT_EQ(sizeof(FlyingPointOptions), 2 * sizeof(int) + 3 * sizeof(double));
  EXPECT_EQ(sizeof(IsolatedPointOptions), 2 * sizeof(int) + 2 * sizeof(double));
  EXPECT_EQ(sizeof(FlippingPointOptions), 2 * sizeof(int) + 2 * sizeof(double));
  EXPECT_EQ(sizeof(UpsampleOptions), 56u);
  EXPECT_EQ(sizeof(LocalPlaneOptions), 64u);
  EXPECT_EQ(sizeof(TgvOptions), 6 * sizeof(double));
  EXPECT_EQ(sizeof(NonlocalOptions), 40u);
  EXPECT_EQ(sizeof(ConfidenceMaskOptions), 2 * sizeof(double));
}

TEST(DepthOptionTable, TextThatIsNoOptionsIsRefused) {
  for (const char* text :
       {"", "{}", "[]", R"({"method":"best"})", R"({"method":5})",
        R"({"method":"paper","tgv.colour":1})", R"({"method":"paper","upsample.iterations":1000})",
        R"({"method":"paper","upsample.iterations":2.5})"})
    EXPECT_FALSE(DepthOptionsFromJson(text)) << text;
}

}  // namespace
}  // namespace foresight
