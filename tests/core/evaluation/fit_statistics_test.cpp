#include "core/evaluation/fit_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/random.h"
#include "core/evaluation/fit_outcome_json.h"
#include "core/evaluation/verdict_fit.h"
#include "core/evaluation/verdict_trial.h"

namespace foresight {
namespace {

FitOutcome Answer(std::uint64_t seed, bool right, double probability) {
  FitOutcome outcome;
  outcome.seed = seed;
  outcome.what = "wheel of 3 spokes";
  outcome.source = "raw";
  outcome.found = true;
  outcome.pose_ok = outcome.all_ok = right;
  outcome.verdict.level = LevelFor(probability, false);
  outcome.verdict.probability = probability;
  outcome.errors = {{"center_mm", right ? 2.0 : 80.0}};
  outcome.seconds = 0.5;
  return outcome;
}

TEST(FitStatistics, AConfirmedNegativeIsNoRightAnswer) {
  std::vector<FitOutcome> outcomes = {Answer(1, true, 0.99), Answer(2, true, 0.97)};
  outcomes[1].positive = false;
  const auto statistics = StatisticsOf(outcomes);
  ASSERT_EQ(statistics.size(), 1u);
  EXPECT_EQ(statistics[0].positives, 1);
  EXPECT_EQ(statistics[0].negatives, 1);
  EXPECT_EQ(statistics[0].confirmed, 2);
  EXPECT_EQ(statistics[0].confirmed_right, 1);
  EXPECT_EQ(statistics[0].negatives_confirmed, 1);
}

TEST(FitStatistics, ASourceHasTheVerdictsOfTheFirstWhereItsAnswersHaveTheSameLevels) {
  std::vector<FitOutcome> outcomes = {Answer(1, true, 0.99), Answer(2, true, 0.99),
                                      Answer(3, true, 0.99), Answer(4, true, 0.99)};
  for (const FitOutcome& outcome : std::vector<FitOutcome>(outcomes)) {
    outcomes.push_back(outcome);
    outcomes.back().source = "cloud";
  }
  outcomes.pop_back();                                // seed 4 was not tried
  outcomes[5].verdict.level = VerdictLevel::kLikely;  // seed 2
  outcomes[6].found = false;                          // seed 3
  const auto statistics = StatisticsOf(outcomes);
  ASSERT_EQ(statistics.size(), 2u);
  EXPECT_EQ(statistics[0].compared, 0);
  EXPECT_EQ(statistics[1].compared, 3);
  EXPECT_EQ(statistics[1].same_verdict, 1);
}

TEST(FitStatistics, TheFirstSourceIsComparedOnTheScenesThatBothHave) {
  std::vector<FitOutcome> outcomes = {Answer(1, true, 0.9), Answer(2, true, 0.9),
                                      Answer(3, false, 0.9), Answer(4, true, 0.9)};
  for (const std::uint64_t seed : {1, 2, 3, 5}) {
    outcomes.push_back(Answer(seed, seed != 2, 0.9));
    outcomes.back().source = "cloud";
  }
  outcomes.push_back(Answer(6, false, 0.9));
  outcomes.back().positive = false;
  const auto statistics = StatisticsOf(outcomes);
  ASSERT_EQ(statistics.size(), 2u);
  EXPECT_EQ(statistics[0].first_ahead.scenes, 0);
  EXPECT_EQ(statistics[1].first_ahead.scenes, 3);
  EXPECT_EQ(statistics[1].first_ahead.only_first, 1);
  EXPECT_EQ(statistics[1].first_ahead.only_second, 1);
}

TEST(FitStatistics, ErrorsAreThoseOfRightAnswers) {
  const std::vector<FitOutcome> outcomes = {Answer(1, true, 0.99), Answer(2, false, 0.3)};
  const auto statistics = StatisticsOf(outcomes);
  ASSERT_EQ(statistics[0].errors.size(), 1u);
  EXPECT_EQ(statistics[0].errors[0].p95, 2.0);
}

TEST(FitStatistics, AucIsTheChanceThatARightAnswerIsMoreProbable) {
  const std::vector<double> probabilities = {0.9, 0.8, 0.4, 0.3};
  EXPECT_DOUBLE_EQ(AreaUnderRoc(probabilities, {true, false, true, false}), 0.75);
  EXPECT_DOUBLE_EQ(AreaUnderRoc(probabilities, {true, true, false, false}), 1.0);
  EXPECT_TRUE(std::isnan(AreaUnderRoc(probabilities, {true, true, true, true})));
}

TEST(FitStatistics, RecallLooksAtWhatIsInViewAndFalseAreaAtWhatIsOffered) {
  const auto block = [](bool found, bool right, double in_view, double false_area,
                        VerdictLevel level) {
    FitOutcome outcome = Answer(1, right, 0.9);
    outcome.found = found;
    outcome.pose_ok = right;
    outcome.verdict.level = level;
    if (found) outcome.errors = {{"in_view", in_view}, {"false_area", false_area}};
    return outcome;
  };
  const std::vector<FitOutcome> outcomes = {
      block(true, true, 1.0, 0.0, VerdictLevel::kConfirmed),
      block(true, true, 1.0, 0.1, VerdictLevel::kLikely),
      block(true, false, 0.0, 1.0, VerdictLevel::kUnsure),  // something else: no miss
      block(false, false, 0.0, 0.0, VerdictLevel::kUnsure)};
  const FitStatistics statistics = StatisticsOf(outcomes).front();
  EXPECT_NEAR(statistics.recall, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(statistics.false_area, 0.05, 1e-12);
}

TEST(FitStatistics, CalibrationErrorIsPromiseLessTruth) {
  const std::vector<double> probabilities(10, 0.95);
  std::vector<bool> right(10, true);
  EXPECT_NEAR(CalibrationErrorOf(probabilities, right), 0.05, 1e-12);
  right[0] = right[1] = false;
  EXPECT_NEAR(CalibrationErrorOf(probabilities, right), 0.15, 1e-12);
}

/// Answers that are right with the probability that their evidence says.
std::vector<FitOutcome> DrawnFromALogistic(int count) {
  Random random(7);
  std::vector<FitOutcome> outcomes;
  for (int i = 0; i < count; ++i) {
    const double margin = 5.0 + 2.0 * random.Normal();
    const double noise = random.Normal();
    const double p = 1.0 / (1.0 + std::exp(-(margin - 5.0)));
    FitOutcome outcome = Answer(static_cast<std::uint64_t>(i), random.Uniform() < p, p);
    outcome.verdict.features = {margin, noise};
    outcomes.push_back(outcome);
  }
  return outcomes;
}

TEST(VerdictFit, FindsTheLogisticThatTheAnswersWereDrawnFrom) {
  VerdictFitOptions options;
  options.object = "valve";
  options.population = "drawn";
  options.features = {"margin", "noise"};
  const auto fit = FitVerdictModel(DrawnFromALogistic(4000), options);
  ASSERT_TRUE(fit) << fit.error().message;
  const VerdictModel* model = &fit->model;
  // One nat of margin is one nat of log odds; a deviation of margin is 2. Four standard errors.
  EXPECT_NEAR(model->features[0].weight, 2.0, 0.3);
  EXPECT_NEAR(model->features[1].weight, 0.0, 0.2);
  EXPECT_LT(model->ece, 0.03);
  EXPECT_GT(model->auc, 0.8);
  const double middle[] = {5.0, 0.0};
  EXPECT_NEAR(model->Probability(middle), 0.5, 0.05);
}

TEST(VerdictFit, TakesPairsWhereOneNumberSaysWhatAnotherIsWorth) {
  VerdictFitOptions options;
  options.object = "valve";
  options.features = {"margin", "noise"};
  std::vector<FitOutcome> outcomes = DrawnFromALogistic(2000);
  // By itself neither says anything: right where both are high or both are low.
  Random random(11);
  for (FitOutcome& outcome : outcomes) {
    const double margin = 0.5 * (outcome.verdict.features[0] - 5.0);
    const double noise = outcome.verdict.features[1];
    outcome.all_ok = random.Uniform() < 1.0 / (1.0 + std::exp(-3.0 * margin * noise));
  }
  options.pair_ridges = {std::numeric_limits<double>::infinity(), 1.0};
  const auto fit = FitVerdictModel(outcomes, options);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_EQ(fit->pair_ridge, 1.0);
  EXPECT_GT(fit->model.auc, 0.8);
  ASSERT_EQ(fit->model.pairs.size(), 3u);
  EXPECT_NEAR(fit->model.pairs[1], 3.0, 0.4);
  const double both_high[] = {8.0, 1.5}, one_high[] = {8.0, -1.5};
  EXPECT_GT(fit->model.Probability(both_high), 0.99);
  EXPECT_LT(fit->model.Probability(one_high), 0.01);
  options.pair_ridges = {std::numeric_limits<double>::infinity()};
  const auto without = FitVerdictModel(outcomes, options);
  ASSERT_TRUE(without);
  EXPECT_TRUE(without->model.pairs.empty());
  EXPECT_LT(without->model.auc, 0.6);
  EXPECT_GT(without->log_loss, 1.3 * fit->log_loss);
  options.pair_ridges = {0.0};
  EXPECT_EQ(FitVerdictModel(outcomes, options).error().code, ErrorCode::kInvalidOptions);
}

TEST(VerdictFit, CountsWhatWouldBeSureByWorld) {
  VerdictFitOptions options;
  options.object = "valve";
  options.features = {"margin", "noise"};
  std::vector<FitOutcome> outcomes = DrawnFromALogistic(8000);
  for (std::size_t i = 0; i < outcomes.size(); i += 4) outcomes[i].world = FitWorld::kVaried;
  const auto fit = FitVerdictModel(outcomes, options);
  ASSERT_TRUE(fit) << fit.error().message;
  ASSERT_EQ(fit->sure.size(), 2u);
  int right = 0;
  for (const SureAnswers& sure : fit->sure) {
    right += sure.right_answers;
    ASSERT_GT(sure.sure.right + sure.sure.wrong, 100);
    EXPECT_LT(sure.sure.right, sure.right_answers);
    EXPECT_LT(sure.sure.wrong, 0.05 * sure.sure.right) << ToString(sure.world);
    EXPECT_LE(sure.sure.negatives, sure.sure.wrong);
    EXPECT_EQ(sure.confirmed.right, sure.sure.right) << "no gate objects";
  }
  EXPECT_EQ(right, std::count_if(outcomes.begin(), outcomes.end(), [](const FitOutcome& outcome) {
              return outcome.positive && outcome.all_ok;
            }));
}

TEST(VerdictFit, AGateOfATrialKeepsBackWhatIsSure) {
  VerdictFitOptions options;
  options.object = "valve";
  options.features = {"margin", "noise"};
  std::vector<FitOutcome> outcomes = DrawnFromALogistic(8000);
  const auto gate = TrialGateFrom("noise>=0");
  ASSERT_TRUE(gate) << gate.error().message;
  ASSERT_TRUE(AddTrialGate(*gate, options.features, outcomes));
  const auto fit = FitVerdictModel(outcomes, options);
  ASSERT_TRUE(fit) << fit.error().message;
  ASSERT_EQ(fit->sure.size(), 1u);
  const SureAnswers& sure = fit->sure.front();
  EXPECT_NEAR(sure.confirmed.right, 0.5 * sure.sure.right, 0.1 * sure.sure.right);
  EXPECT_LE(sure.confirmed.wrong, sure.sure.wrong);
}

TEST(VerdictFit, OtherEvidenceInThePlaceOfTheFeaturesIsWorthWhatItTells) {
  VerdictFitOptions options;
  options.object = "valve";
  const std::vector<std::string> names = {"margin", "noise"};
  std::vector<FitOutcome> outcomes = DrawnFromALogistic(4000);
  for (FitOutcome& outcome : outcomes)
    outcome.evidence = {{"margin_again", outcome.verdict.features.front()}};
  const auto log_loss = [&](const std::vector<std::string>& wanted) {
    std::vector<FitOutcome> changed = outcomes;
    EXPECT_TRUE(ReplaceFeatures(wanted, names, changed));
    options.features = wanted;
    const auto fit = FitVerdictModel(changed, options);
    EXPECT_TRUE(fit) << fit.error().message;
    return fit ? fit->log_loss : 0.0;
  };
  const double both = log_loss(names);
  EXPECT_NEAR(log_loss({"margin_again"}), both, 0.01);
  EXPECT_NEAR(log_loss({"compressed:margin_again", "noise"}), both, 0.05);
  EXPECT_NEAR(log_loss({"noise"}), std::log(2.0), 0.02) << "it tells nothing";
  EXPECT_LT(both, 0.55);
  std::vector<FitOutcome> changed = outcomes;
  const Status unknown = ReplaceFeatures({"rim"}, names, changed);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("margin_again"), std::string::npos)
      << unknown.error().message;
}

TEST(VerdictFit, AGateOfATrialSaysWhatItShouldLookLike) {
  for (const char* text : {"", "rim", "rim>=", ">=3", "rim>=x", "rim>=3 mm", "rim=3", "rim<=nan"}) {
    const auto gate = TrialGateFrom(text);
    ASSERT_FALSE(gate) << text;
    EXPECT_NE(gate.error().message.find("NAME>=NUMBER"), std::string::npos);
  }
  const auto gate = TrialGateFrom("log_chance_off<=-3.5");
  ASSERT_TRUE(gate);
  EXPECT_EQ(gate->name, "log_chance_off");
  EXPECT_FALSE(gate->at_least);
  EXPECT_EQ(gate->limit, -3.5);
}

TEST(VerdictFit, ExtraNegativesDoNotMakeTheObjectRare) {
  VerdictFitOptions options;
  options.object = "valve";
  options.features = {"margin", "noise"};
  const std::vector<FitOutcome> drawn = DrawnFromALogistic(2000);
  const auto with_negatives = [&](int count) {
    std::vector<FitOutcome> outcomes = drawn;
    for (int i = 0; i < count; ++i) {
      FitOutcome negative = drawn[static_cast<std::size_t>(i) % drawn.size()];
      negative.seed = 100000 + static_cast<std::uint64_t>(i);
      negative.positive = negative.all_ok = false;
      outcomes.push_back(negative);
    }
    return FitVerdictModel(outcomes, options);
  };
  const auto few = with_negatives(400), many = with_negatives(4000);  // one in six, two in three
  ASSERT_TRUE(few && many);
  const double good[] = {9.0, 0.0};
  EXPECT_NEAR(many->model.Probability(good), few->model.Probability(good), 0.04);
}

TEST(VerdictFit, RefusesAPopulationWithoutWrongAnswers) {
  VerdictFitOptions options;
  options.object = "valve";
  options.features = {"margin", "noise"};
  std::vector<FitOutcome> outcomes = DrawnFromALogistic(100);
  for (FitOutcome& outcome : outcomes) outcome.all_ok = true;
  const auto model = FitVerdictModel(outcomes, options);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::kTooFewPoints);
}

TEST(FitOutcomes, SurviveTheirFileAndATornLastLineIsLeftOut) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "outcomes.jsonl";
  FitOutcome outcome = Answer(12, true, 0.971);
  outcome.verdict.features = {1.25, std::nan("")};
  outcome.reason = "the rim \"is\" seen";
  outcome.verdict.failed_gates = {"31 measurements lie on the valve (at least 40)"};
  outcome.evidence = {{"rim_nats", 640.5}, {"see_through", std::nan("")}};
  {
    std::ofstream stream(path);
    stream << FitOutcomeToJson(outcome) << "\n" << FitOutcomeToJson(outcome).substr(0, 40);
  }
  const auto loaded = LoadFitOutcomes(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->size(), 1u);
  EXPECT_EQ(loaded->front().seed, 12u);
  EXPECT_EQ(loaded->front().verdict.level, VerdictLevel::kConfirmed);
  EXPECT_EQ(loaded->front().verdict.failed_gates, outcome.verdict.failed_gates);
  ASSERT_EQ(loaded->front().evidence.size(), 2u);
  EXPECT_EQ(loaded->front().evidence.front(), outcome.evidence.front());
  EXPECT_TRUE(std::isnan(loaded->front().evidence.back().second));
  EXPECT_EQ(loaded->front().verdict.features[0], 1.25);
  EXPECT_TRUE(std::isnan(loaded->front().verdict.features[1]));
  EXPECT_EQ(loaded->front().reason, outcome.reason);
}

TEST(FitOutcomes, ADamagedLineIsNamed) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "damaged.jsonl";
  {
    std::ofstream stream(path);
    stream << FitOutcomeToJson(Answer(1, true, 0.9)) << "\n{\"seed\": 3}\n";
  }
  const auto loaded = LoadFitOutcomes(path);
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("damaged.jsonl:2"), std::string::npos);
}

}  // namespace
}  // namespace foresight
