#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/evaluation/fit_trial.h"
#include "core/evaluation/paired_lead.h"

namespace foresight {

/// Middle and tail of one kind of error, over the answers that are right where it counts.
struct ErrorSpread {
  std::string name;
  double median = 0.0;
  double p95 = 0.0;
};

/// How far errors lie from what their covariance says, for one direction: 1 where it is right.
struct SigmaSpread {
  std::string name;     ///< "x", "tilt_y", ...
  double robust = 0.0;  ///< the median of |error| / deviation over that of a normal error
  double rms = 0.0;     ///< root mean square of error / deviation
};

/// How often a reason was given; numbers in it are written as "#".
struct ReasonCount {
  std::string reason;
  int count = 0;
};

/// How one source did over a population.
struct FitStatistics {
  std::string source;
  int positives = 0;
  int found = 0;  ///< answers to positives
  int pose_ok = 0;
  int all_ok = 0;
  /// Of what was there to be found, the fraction found: of the positives or, where outcomes say
  /// "in_view", of what was in view. NaN without any.
  double recall = 0.0;
  /// Mean "false_area" of the answers that are LIKELY or CONFIRMED; NaN where there is none.
  double false_area = 0.0;
  std::vector<ErrorSpread> errors;
  std::vector<SigmaSpread> sigmas;  ///< spread over predicted, of answers that are right
  /// Why answers that are right in every respect are not CONFIRMED, the most frequent first.
  std::vector<ReasonCount> right_not_confirmed;
  int confirmed = 0;        ///< of all answers, negatives' too
  int confirmed_right = 0;  ///< all_ok
  int likely = 0;
  int likely_right = 0;
  int negatives = 0;  ///< scenes
  int negatives_confirmed = 0;
  int negatives_likely = 0;
  double auc = 0.0;             ///< of the probability, for "all ok"; NaN without both kinds
  double ece = 0.0;             ///< expected calibration error, ten bins
  double seconds_median = 0.0;  ///< CPU of a fit
  double seconds_p95 = 0.0;
  /// Scenes that both this and the first source were tried on, and those of them in which as many
  /// answers are CONFIRMED, LIKELY, UNSURE and not there; 0 for the first source itself.
  int compared = 0;
  int same_verdict = 0;
  /// By how much the first source is ahead in answers that are right where it counts, over the
  /// scenes with the object in them that both were tried on; none for the first source itself.
  PairedLead first_ahead;
};

/// One entry a source, in the order they first appear.
std::vector<FitStatistics> StatisticsOf(std::span<const FitOutcome> outcomes);

/// Area under the ROC curve; ties count half. NaN where all labels are the same.
double AreaUnderRoc(std::span<const double> probabilities, const std::vector<bool>& right);

/// Mean distance between what was promised and what came true, in ten bins of probability weighted
/// by how many fell into each; `weights`, where there are any, say how many each one stands for.
double CalibrationErrorOf(std::span<const double> probabilities, const std::vector<bool>& right,
                          std::span<const double> weights = {});

}  // namespace foresight
