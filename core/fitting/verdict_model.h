#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

struct RaySet;

/// What evidence was gathered from: it weighs differently.
enum class VerdictSource {
  kRaw,    ///< lidar returns, and the image beside them for objects that look at it
  kCloud,  ///< lidar returns alone
  kDense,  ///< a dense map, whose neighbouring rays are not independent, and the beams behind it
  kAlone,  ///< a dense map alone
};
/// "raw", "cloud", "dense", "alone".
const char* ToString(VerdictSource source);
/// nullopt for any other word.
std::optional<VerdictSource> VerdictSourceFromString(std::string_view name);
VerdictSource VerdictSourceOf(const RaySet& rays);

/// The probability that a fit is right: logistic regression on standardised evidence z and, where
/// they help, on its products in pairs,
///   log odds = bias + w z + sum over i >= j of q_ij z_i z_j,
/// as what a number is worth depends on others: see-through says less where few beams hit (ADR
/// 0029). Every object has one for each source. The files are made by `foresightctl
/// verdict fit`, docs/verdicts.md, and hold the population that they are true for.
struct VerdictModel {
  struct Feature {
    std::string name;
    double mean = 0.0;
    double deviation = 1.0;
    double weight = 0.0;  ///< of (value - mean) / deviation
  };

  std::string object;  ///< "valve", "drill", "terrain", "handle"
  VerdictSource source = VerdictSource::kRaw;
  std::string population;  ///< how it was made: scenes, seeds, sources
  int fits = 0;            ///< in the population
  int right = 0;           ///< of them
  double auc = 0.0;        ///< area under the ROC curve, cross-validated
  double ece = 0.0;        ///< expected calibration error, cross-validated
  std::vector<Feature> features;
  double bias = 0.0;
  /// q_ij of each pair of features, i >= j, row by row of i; empty = none.
  std::vector<double> pairs;

  static constexpr std::size_t PairsOf(std::size_t features) {
    return features * (features + 1) / 2;
  }

  /// In [0, 1]; 0 where a value is not finite. Values beyond 4 deviations count as 4: nothing is
  /// known out there. Throws ContractViolation for another number of values than features.
  double Probability(std::span<const double> values) const;

  /// What each value adds to the logarithm of the odds, against that value at its mean and the
  /// others as they are. NaN where it is not finite. Values as for Probability.
  std::vector<double> Contributions(std::span<const double> values) const;

  /// Why nothing may be CONFIRMED by this model: its population is too small to promise 98 of 100.
  /// Empty when it is large enough.
  std::string Reservation() const;
  /// Adds that to what objects already.
  void AddReservation(std::vector<std::string>& failed_gates) const;
  static constexpr int kLeastFits = 150;

  std::string ToYaml() const;

 private:
  /// z: in deviations from the mean, within what was seen; NaN where a value is not finite.
  std::vector<double> Standardised(std::span<const double> values) const;
};

/// Fails with kBadData, naming `source` and the line at fault.
Result<VerdictModel> VerdictModelFromYaml(const std::string& yaml, const std::string& source);

/// resources/verdicts/<object>_<source>.yaml as it was when the program was built, kRaw's for
/// kCloud where there is no other; nullptr where there is none, as before an object's first weights
/// were fitted.
const VerdictModel* FindVerdictModel(std::string_view object, VerdictSource source);
/// The same of an object that has one. Throws ContractViolation where there is none.
const VerdictModel& ShippedVerdictModel(std::string_view object, VerdictSource source);

}  // namespace foresight
