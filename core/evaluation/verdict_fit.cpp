#include "core/evaluation/verdict_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/evaluation/fit_statistics.h"
#include "core/evaluation/logistic_regression.h"

namespace foresight {
namespace {

constexpr int kMinOfEach = 10;
constexpr double kLeastDeviation = 1e-9;

struct Example {
  std::vector<double> values;
  bool right = false;
  bool positive = false;
  bool objected = false;
  FitWorld world = FitWorld::kHome;
  std::uint64_t seed = 0;
  double weight = 1.0;
};

/// Of the answers in scenes without the object.
double WeightOfNegatives(std::span<const FitOutcome> outcomes, double fraction) {
  std::set<std::uint64_t> positives, negatives;
  for (const FitOutcome& outcome : outcomes)
    (outcome.positive ? positives : negatives).insert(outcome.seed);
  if (negatives.empty()) return 1.0;
  return std::min(1.0, fraction / (1.0 - fraction) * static_cast<double>(positives.size()) /
                           static_cast<double>(negatives.size()));
}

std::vector<Example> ExamplesFrom(std::span<const FitOutcome> outcomes,
                                  const VerdictFitOptions& options) {
  const double of_negatives = WeightOfNegatives(outcomes, options.negative_fraction);
  std::vector<Example> examples;
  for (const FitOutcome& outcome : outcomes) {
    const std::vector<double>& values = outcome.verdict.features;
    if (!outcome.found || values.size() != options.features.size()) continue;
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
      continue;
    examples.push_back({values, outcome.positive && outcome.all_ok, outcome.positive,
                        !outcome.verdict.failed_gates.empty(), outcome.world, outcome.seed,
                        outcome.positive ? 1.0 : of_negatives});
  }
  return examples;
}

/// Mean and deviation of each feature.
void Standardise(const std::vector<Example>& examples, VerdictModel& model) {
  const double n = static_cast<double>(examples.size());
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    double sum = 0.0, squares = 0.0;
    for (const Example& example : examples) sum += example.values[f];
    for (const Example& example : examples)
      squares += (example.values[f] - sum / n) * (example.values[f] - sum / n);
    model.features[f].mean = sum / n;
    model.features[f].deviation = std::max(std::sqrt(squares / n), kLeastDeviation);
  }
}

/// What the log odds are linear in: a constant, the features in deviations, and their pairs.
struct Design {
  Eigen::MatrixXd x;           ///< (examples x columns)
  Eigen::VectorXd pair_means;  ///< of the pairs' columns before they were standardised
  Eigen::VectorXd pair_deviations;
};

Design DesignOf(const std::vector<Example>& examples, const VerdictModel& model, bool pairs) {
  const auto rows = static_cast<Eigen::Index>(examples.size());
  const auto features = static_cast<Eigen::Index>(model.features.size());
  const auto pair_count =
      pairs ? static_cast<Eigen::Index>(VerdictModel::PairsOf(model.features.size())) : 0;
  Design design{Eigen::MatrixXd(rows, 1 + features + pair_count), Eigen::VectorXd(pair_count),
                Eigen::VectorXd(pair_count)};
  Eigen::MatrixXd& x = design.x;
  x.col(0).setOnes();
  for (Eigen::Index f = 0; f < features; ++f) {
    const auto& feature = model.features[static_cast<std::size_t>(f)];
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double value =
          examples[static_cast<std::size_t>(i)].values[static_cast<std::size_t>(f)];
      // As VerdictModel::Probability clamps.
      x(i, 1 + f) = std::clamp((value - feature.mean) / feature.deviation, -4.0, 4.0);
    }
  }
  Eigen::Index pair = 0;
  for (Eigen::Index f = 0; pair < pair_count; ++f)
    for (Eigen::Index g = 0; g <= f; ++g, ++pair) {
      auto column = x.col(1 + features + pair);
      column = x.col(1 + f).cwiseProduct(x.col(1 + g));
      design.pair_means[pair] = column.mean();
      column.array() -= design.pair_means[pair];
      design.pair_deviations[pair] =
          std::max(std::sqrt(column.squaredNorm() / static_cast<double>(rows)), kLeastDeviation);
      column /= design.pair_deviations[pair];
    }
  return design;
}

Eigen::VectorXd SolveWeights(const std::vector<Example>& examples, const Eigen::MatrixXd& x,
                             const Eigen::VectorXd& penalty) {
  Eigen::VectorXd y(x.rows()), counts(x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    y(i) = examples[static_cast<std::size_t>(i)].right ? 1.0 : 0.0;
    counts(i) = examples[static_cast<std::size_t>(i)].weight;
  }
  return LogisticWeights(x, y, counts, penalty);
}

/// The bias is not penalised.
VerdictModel Fitted(const std::vector<Example>& examples, double ridge, double pair_ridge,
                    VerdictModel model) {
  Standardise(examples, model);
  const Design design = DesignOf(examples, model, std::isfinite(pair_ridge));
  const auto features = static_cast<Eigen::Index>(model.features.size());
  const Eigen::Index pair_count = design.pair_means.size();
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(design.x.cols(), ridge);
  penalty(0) = 0.0;
  penalty.tail(pair_count).setConstant(pair_ridge);
  const Eigen::VectorXd weights = SolveWeights(examples, design.x, penalty);
  for (Eigen::Index f = 0; f < features; ++f)
    model.features[static_cast<std::size_t>(f)].weight = weights(1 + f);
  const Eigen::VectorXd of_products =
      weights.tail(pair_count).cwiseQuotient(design.pair_deviations);
  model.pairs.assign(of_products.begin(), of_products.end());
  model.bias = weights(0) - of_products.dot(design.pair_means);
  return model;
}

/// Probability of each example by a model that has not seen its scene.
std::vector<double> CrossValidated(const std::vector<Example>& examples,
                                   const VerdictFitOptions& options, double pair_ridge,
                                   const VerdictModel& blank) {
  const auto folds = static_cast<std::uint64_t>(options.folds);
  std::vector<double> probabilities(examples.size(), 0.0);
  for (std::uint64_t fold = 0; fold < folds; ++fold) {
    std::vector<Example> others;
    for (const Example& example : examples)
      if (example.seed % folds != fold) others.push_back(example);
    if (others.empty()) continue;
    const VerdictModel model = Fitted(others, options.ridge, pair_ridge, blank);
    for (std::size_t i = 0; i < examples.size(); ++i)
      if (examples[i].seed % folds == fold)
        probabilities[i] = model.Probability(examples[i].values);
  }
  return probabilities;
}

void CountIn(const Example& example, SureAnswers::Count& count) {
  ++(example.right ? count.right : count.wrong);
  count.negatives += !example.positive;
}

double LogLossOf(const std::vector<Example>& examples, const std::vector<double>& probabilities) {
  constexpr double kLeast = 1e-9;
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < examples.size(); ++i) {
    const double promised = examples[i].right ? probabilities[i] : 1.0 - probabilities[i];
    sum -= examples[i].weight * std::log(std::max(kLeast, promised));
    weights += examples[i].weight;
  }
  return sum / weights;
}

std::vector<SureAnswers> CountSure(const std::vector<Example>& examples,
                                   const std::vector<double>& probabilities) {
  std::vector<SureAnswers> counts;
  for (const FitWorld world : {FitWorld::kHome, FitWorld::kVaried}) {
    SureAnswers count{world};
    bool any = false;
    for (std::size_t i = 0; i < examples.size(); ++i) {
      const Example& example = examples[i];
      if (example.world != world) continue;
      any = true;
      count.right_answers += example.right;
      if (probabilities[i] < Verdict::kConfirmed) continue;
      CountIn(example, count.sure);
      if (!example.objected) CountIn(example, count.confirmed);
    }
    if (any) counts.push_back(count);
  }
  return counts;
}

}  // namespace

Status VerdictFitOptions::Check() const {
  if (features.empty())
    return Fail(ErrorCode::kInvalidOptions, "verdict of {}: there are no features", object);
  if (!(negative_fraction > 0.0 && negative_fraction < 1.0))
    return Fail(ErrorCode::kInvalidOptions, "verdict of {}: negative_fraction {} is not in (0, 1)",
                object, negative_fraction);
  if (!(ridge >= 0.0) || folds < 2)
    return Fail(ErrorCode::kInvalidOptions, "verdict of {}: ridge {} or folds {} is not usable",
                object, ridge, folds);
  if (pair_ridges.empty() || !(*std::min_element(pair_ridges.begin(), pair_ridges.end()) > 0.0))
    return Fail(ErrorCode::kInvalidOptions, "verdict of {}: a pair_ridge must be above 0", object);
  return {};
}

Result<VerdictFit> FitVerdictModel(std::span<const FitOutcome> outcomes,
                                   const VerdictFitOptions& options) {
  FORESIGHT_CHECK(options.Check());
  for (const FitOutcome& outcome : outcomes)
    if (outcome.world == FitWorld::kOther)
      return Fail(ErrorCode::kInvalidInput,
                  "verdict of {}: seed {} is of the {} world, which judges only: nothing is ever "
                  "fitted to it",
                  options.object, outcome.seed, ToString(outcome.world));
  const std::vector<Example> examples = ExamplesFrom(outcomes, options);
  const auto right = static_cast<int>(
      std::count_if(examples.begin(), examples.end(), [](const Example& e) { return e.right; }));
  const int wrong = static_cast<int>(examples.size()) - right;
  if (right < kMinOfEach || wrong < kMinOfEach)
    return Fail(
        ErrorCode::kTooFewPoints,
        "verdict of {}: {} right and {} wrong answers; {} of each are needed: use more seeds",
        options.object, right, wrong, kMinOfEach);
  VerdictModel blank;
  blank.object = options.object;
  blank.source = options.source;
  blank.population = options.population;
  blank.fits = static_cast<int>(examples.size());
  blank.right = right;
  for (const std::string& name : options.features) blank.features.push_back({name, 0.0, 1.0, 0.0});
  VerdictFit fit;
  fit.pair_ridges = options.pair_ridges;
  std::vector<double> left_out;
  for (const double pair_ridge : options.pair_ridges) {
    std::vector<double> tried = CrossValidated(examples, options, pair_ridge, blank);
    const double loss = LogLossOf(examples, tried);
    fit.log_losses.push_back(loss);
    if (!left_out.empty() && loss >= fit.log_loss) continue;
    fit.log_loss = loss;
    fit.pair_ridge = pair_ridge;
    left_out = std::move(tried);
  }
  std::vector<bool> labels;
  std::vector<double> weights;
  for (const Example& example : examples) {
    labels.push_back(example.right);
    weights.push_back(example.weight);
  }
  blank.auc = AreaUnderRoc(left_out, labels);
  blank.ece = CalibrationErrorOf(left_out, labels, weights);
  fit.model = Fitted(examples, options.ridge, fit.pair_ridge, blank);
  fit.sure = CountSure(examples, left_out);
  return fit;
}

}  // namespace foresight
