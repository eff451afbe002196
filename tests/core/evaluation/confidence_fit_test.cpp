#include "core/evaluation/confidence_fit.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace foresight {
namespace {

/// Pixels that are right as often as the program's weights say.
ConfidenceExamples Drawn(const char* scene, int pixels, std::uint64_t seed) {
  Random random(seed);
  ConfidenceExamples examples{scene, 1, {}, {}};
  for (int i = 0; i < pixels; ++i) {
    SupportTerms terms;
    terms[kNearestCells] = static_cast<float>(random.Uniform(0.0, 1.5));
    terms[kSquaredWeight] = static_cast<float>(random.Uniform(0.0, 1.0));
    terms[kOneSidedRow] = random.Chance(0.3) ? 1.0f : 0.0f;
    terms[kOneSidedColumn] = random.Chance(0.3) ? 1.0f : 0.0f;
    terms[kAgreement] = static_cast<float>(random.Uniform(0.0, 1.0));
    terms[kInsideCell] = random.Chance(0.5) ? 1.0f : 0.0f;
    examples.terms.push_back(terms);
    examples.right.push_back(random.Uniform() < ShippedConfidenceWeights().Confidence(terms));
  }
  return examples;
}

TEST(FitConfidence, FindsTheWeightsThatPixelsWereDrawnBy) {
  const std::vector<ConfidenceExamples> examples = {Drawn("a", 60000, 1), Drawn("b", 60000, 2)};
  const ConfidenceWeights fitted = FitConfidence(examples);
  const ConfidenceWeights& shipped = ShippedConfidenceWeights();
  EXPECT_NEAR(fitted.bias, shipped.bias, 0.15);
  for (std::size_t i = 0; i < kSupportTerms; ++i)
    EXPECT_NEAR(fitted.of[i], shipped.of[i], 0.15) << i;
  EXPECT_LE(PromiseOf(fitted, examples).log_loss, PromiseOf(shipped, examples).log_loss + 1e-6);
}

TEST(FitConfidence, AScenesPixelsCountAlikeHoweverMany) {
  // One scene is always wrong: as large as the other, or a hundred times as small, it is half.
  const auto even = [](int pixels, bool right) {
    return ConfidenceExamples{right ? "right" : "wrong", 1,
                              std::vector<SupportTerms>(static_cast<std::size_t>(pixels)),
                              std::vector<bool>(static_cast<std::size_t>(pixels), right)};
  };
  const ConfidenceWeights fitted = FitConfidence({even(10000, true), even(100, false)});
  EXPECT_NEAR(fitted.Confidence({}), 0.5, 1e-3);
}

TEST(PromiseOf, SaysHowOftenEachClassIsRight) {
  ConfidenceExamples examples{"a", 1, {}, {}};
  const ConfidenceWeights half{};
  for (int i = 0; i < 100; ++i) {
    examples.terms.push_back({});
    examples.right.push_back(i < 80);
  }
  const ConfidencePromise promise = PromiseOf(half, {examples});
  EXPECT_EQ(promise.classes[5].pixels, 100u);
  EXPECT_DOUBLE_EQ(promise.classes[5].promised, 0.5);
  EXPECT_DOUBLE_EQ(promise.classes[5].right, 0.8);
  EXPECT_NEAR(promise.log_loss, std::log(2.0), 1e-9);
}

}  // namespace
}  // namespace foresight
