#include "core/fitting/verdict_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/contract.h"
#include "core/fitting/verdict.h"

namespace foresight {
namespace {

VerdictModel TwoFeatures() {
  VerdictModel model;
  model.object = "valve";
  model.source = VerdictSource::kAlone;
  model.population = "seeds 1 to 9";
  model.fits = 9;
  model.right = 7;
  model.auc = 0.95;
  model.ece = 0.02;
  model.bias = 0.5;
  model.features = {{"log_margin", 3.0, 1.5, 2.0}, {"see_through", 0.1, 0.05, -1.0}};
  return model;
}

TEST(Verdict, ShowsNoProbabilityAsCertain) {
  EXPECT_EQ(ProbabilityText(1.0), "over 99 %");
  EXPECT_EQ(ProbabilityText(0.9962), "over 99 %");
  EXPECT_EQ(ProbabilityText(0.948), "94 %");  // and not the 95 % that CONFIRMED would need
  EXPECT_EQ(ProbabilityText(0.29), "29 %");
  EXPECT_EQ(ProbabilityText(0.0), "under 1 %");
  EXPECT_EQ(ProbabilityText(std::nan("")), "no probability");
}

TEST(VerdictModel, IsLogisticInStandardisedEvidence) {
  const double values[] = {4.5, 0.15};
  EXPECT_NEAR(TwoFeatures().Probability(values), 1.0 / (1.0 + std::exp(-1.5)), 1e-12);
}

VerdictModel WithPairs() {
  VerdictModel model = TwoFeatures();
  model.pairs = {0.1, 0.7, -0.3};  // margin with itself, see-through with it and with itself
  return model;
}

TEST(VerdictModel, PairsOfEvidenceCountByTheirProducts) {
  const double values[] = {4.5, 0.15};  // 1 deviation each
  EXPECT_NEAR(WithPairs().Probability(values), 1.0 / (1.0 + std::exp(-2.0)), 1e-12);
  const double doubled[] = {6.0, 0.05};  // 2 and -1: 0.5 + 4 + 1 + 0.4 - 1.4 - 0.3
  EXPECT_NEAR(WithPairs().Probability(doubled), 1.0 / (1.0 + std::exp(-4.2)), 1e-12);
}

TEST(VerdictModel, AContributionIsWhatTheOddsChangeByWhereTheValueIsAtItsMean) {
  const auto log_odds = [](double margin, double see_through) {
    const double p = WithPairs().Probability(std::vector<double>{margin, see_through});
    return std::log(p / (1.0 - p));
  };
  const auto contributions = WithPairs().Contributions(std::vector<double>{6.0, 0.05});
  EXPECT_NEAR(contributions[0], log_odds(6.0, 0.05) - log_odds(3.0, 0.05), 1e-12);
  EXPECT_NEAR(contributions[1], log_odds(6.0, 0.05) - log_odds(6.0, 0.1), 1e-12);
}

TEST(VerdictModel, PairsSurviveTheirFileAndMustBeAsManyAsThereAre) {
  const auto read = VerdictModelFromYaml(WithPairs().ToYaml(), "pairs.yaml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->pairs, WithPairs().pairs);
  VerdictModel one_missing = WithPairs();
  std::string text = one_missing.ToYaml();
  text.replace(text.find("0.7, "), 5, "");
  EXPECT_FALSE(VerdictModelFromYaml(text, "pairs.yaml"));
}

TEST(VerdictModel, EvidenceBeyondAllThatWasSeenCountsAsTheFarthestSeen) {
  const double far[] = {9.0, 0.1};
  const double absurd[] = {1e9, 0.1};
  EXPECT_EQ(TwoFeatures().Probability(far), TwoFeatures().Probability(absurd));
}

TEST(VerdictModel, KnowsNothingWithoutANumber) {
  const double values[] = {std::nan(""), 0.1};
  EXPECT_EQ(TwoFeatures().Probability(values), 0.0);
}

TEST(VerdictModel, AnotherNumberOfValuesIsOurMistake) {
  const double values[] = {1.0};
  EXPECT_THROW(TwoFeatures().Probability(values), ContractViolation);
}

TEST(VerdictModel, SurvivesItsFile) {
  const auto read = VerdictModelFromYaml(TwoFeatures().ToYaml(), "test");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->source, VerdictSource::kAlone);
  EXPECT_EQ(read->population, "seeds 1 to 9");
  ASSERT_EQ(read->features.size(), 2u);
  EXPECT_EQ(read->features[1].name, "see_through");
  const double values[] = {4.0, 0.12};
  EXPECT_NEAR(read->Probability(values), TwoFeatures().Probability(values), 1e-9);
}

TEST(VerdictModel, ASmallPopulationConfirmsNothing) {
  VerdictModel model = TwoFeatures();
  EXPECT_NE(model.Reservation().find("9 such answers were tried (at least 150)"),
            std::string::npos);
  model.fits = 200;
  EXPECT_EQ(model.Reservation(), "");
}

TEST(VerdictModel, AFaultNamesItsLine) {
  std::string yaml = TwoFeatures().ToYaml();
  yaml.replace(yaml.find("source: alone"), 13, "source: foggy");
  const auto read = VerdictModelFromYaml(yaml, "valve.yaml");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("valve.yaml:4"), std::string::npos) << read.error().message;
}

}  // namespace
}  // namespace foresight
