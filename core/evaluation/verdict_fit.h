#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/evaluation/fit_trial.h"
#include "core/fitting/verdict_model.h"

namespace foresight {

struct VerdictFitOptions {
  std::string object;  ///< "valve"
  VerdictSource source = VerdictSource::kRaw;
  std::string population;             ///< goes into the model's file
  std::vector<std::string> features;  ///< names, as Verdict::features holds them
  /// Of the scenes. Where more hold something else they count for less, as if these were as many:
  /// extra negatives teach what must not be confirmed, not that drills are rare.
  double negative_fraction = 1.0 / 6.0;
  double ridge = 1.0;  ///< pull of each weight towards 0, in fits' worth
  /// The same of each pair of features; infinite = no pairs. What promises best of scenes that were
  /// left out is taken.
  std::vector<double> pair_ridges = {std::numeric_limits<double>::infinity(), 100.0, 40.0, 20.0};
  int folds = 5;

  Status Check() const;
};

/// What weights that have not seen an answer's scene would make of the answers of one world.
struct SureAnswers {
  struct Count {
    int right = 0;
    int wrong = 0;
    int negatives = 0;  ///< of the wrong ones, those where there was nothing to find
  };
  FitWorld world = FitWorld::kHome;
  int right_answers = 0;  ///< in the world, sure or not
  Count sure = {};        ///< with at least Verdict::kConfirmed, whatever hard gates say
  Count confirmed = {};   ///< of these, those that no gate kept back (Verdict::failed_gates)
};

struct VerdictFit {
  VerdictModel model;
  /// Mean of -log(what was promised for what came true), cross-validated as AUC and ECE are.
  double log_loss = 0.0;
  double pair_ridge = 0.0;          ///< that was taken
  std::vector<double> pair_ridges;  ///< that were tried
  std::vector<double> log_losses;   ///< of each of them
  std::vector<SureAnswers> sure;    ///< a world that has answers
};

/// Weights of the probability that an answer is right in every respect, from judged answers (those
/// found, negatives too), by penalised maximum likelihood on standardised evidence and its pairs.
/// AUC and ECE are those of folds that were left out; answers of one scene stay in one fold. Fails
/// with kInvalidOptions, kInvalidInput (answers of the other world) and kTooFewPoints (fewer than
/// 10 right or 10 wrong answers, no evidence).
Result<VerdictFit> FitVerdictModel(std::span<const FitOutcome> outcomes,
                                   const VerdictFitOptions& options);

}  // namespace foresight
