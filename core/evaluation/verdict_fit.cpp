#include "core/evaluation/verdict_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/evaluation/fit_statistics.h"

namespace foresight {
namespace {

constexpr int kMinOfEach = 10;
constexpr int kNewtonSteps = 30;
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

/// Newton's method on the penalised log likelihood; the bias is not penalised.
void SolveWeights(const std::vector<Example>& examples, double ridge, VerdictModel& model) {
  const auto rows = static_cast<Eigen::Index>(examples.size());
  const auto columns = static_cast<Eigen::Index>(model.features.size()) + 1;
  Eigen::MatrixXd x(rows, columns);
  Eigen::VectorXd y(rows), counts(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Example& example = examples[static_cast<std::size_t>(i)];
    x(i, 0) = 1.0;
    y(i) = example.right ? 1.0 : 0.0;
    counts(i) = example.weight;
    for (Eigen::Index f = 1; f < columns; ++f) {
      const auto& feature = model.features[static_cast<std::size_t>(f - 1)];
      // As VerdictModel::Probability clamps.
      x(i, f) = std::clamp(
          (example.values[static_cast<std::size_t>(f - 1)] - feature.mean) / feature.deviation,
          -4.0, 4.0);
    }
  }
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(columns, ridge);
  penalty(0) = 0.0;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(columns);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::VectorXd p = (1.0 / (1.0 + (-(x * weights)).array().exp())).matrix();
    const Eigen::VectorXd curvature =
        (counts.array() * p.array() * (1.0 - p.array())).max(1e-9).matrix();
    const Eigen::VectorXd gradient =
        x.transpose() * counts.cwiseProduct(y - p) - penalty.cwiseProduct(weights);
    Eigen::MatrixXd hessian = x.transpose() * curvature.asDiagonal() * x;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd change = hessian.ldlt().solve(gradient);
    weights += change;
    if (change.norm() < 1e-9) break;
  }
  model.bias = weights(0);
  for (Eigen::Index f = 1; f < columns; ++f)
    model.features[static_cast<std::size_t>(f - 1)].weight = weights(f);
}

VerdictModel Fitted(const std::vector<Example>& examples, double ridge, VerdictModel model) {
  Standardise(examples, model);
  SolveWeights(examples, ridge, model);
  return model;
}

/// Probability of each example by a model that has not seen its scene.
std::vector<double> CrossValidated(const std::vector<Example>& examples,
                                   const VerdictFitOptions& options, const VerdictModel& blank) {
  const auto folds = static_cast<std::uint64_t>(options.folds);
  std::vector<double> probabilities(examples.size(), 0.0);
  for (std::uint64_t fold = 0; fold < folds; ++fold) {
    std::vector<Example> others;
    for (const Example& example : examples)
      if (example.seed % folds != fold) others.push_back(example);
    if (others.empty()) continue;
    const VerdictModel model = Fitted(others, options.ridge, blank);
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
  const std::vector<double> left_out = CrossValidated(examples, options, blank);
  std::vector<bool> labels;
  std::vector<double> weights;
  for (const Example& example : examples) {
    labels.push_back(example.right);
    weights.push_back(example.weight);
  }
  blank.auc = AreaUnderRoc(left_out, labels);
  blank.ece = CalibrationErrorOf(left_out, labels, weights);
  return VerdictFit{Fitted(examples, options.ridge, blank), LogLossOf(examples, left_out),
                    CountSure(examples, left_out)};
}

}  // namespace foresight
