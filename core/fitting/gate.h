#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/fitting/verdict.h"
#include "core/fitting/verdict_model.h"

namespace foresight {

/// One number that an answer has to keep on one side of a limit, and how an operator is told where
/// it does not. Every reason of a verdict with a number in it is made here, so that the number and
/// the limit in a sentence are those of the gate that failed, and differ as printed.
struct Gate {
  enum class Side { kAtLeast, kAtMost };
  enum class Unit {
    kCount,
    kFraction,  ///< "22 %"
    kRatio,     ///< "1.19"
    kLength,    ///< metres: "31 mm"
    kAngle,     ///< radians: "2.4 deg"
    kOdds,      ///< nats: "12 : 1", "1 : 400", "10^13 : 1"
  };
  /// How much it weighs.
  enum class Kind {
    kHard,   ///< "(at least 40)"
    kUsual,  ///< a mean of others, which only moves the probability: "(usually at least 60 %)"
  };

  std::string what;  ///< with "{}" for the number: "{} measurements lie on the valve"
  Unit unit = Unit::kCount;
  double number = 0.0;
  Side side = Side::kAtLeast;
  double limit = 0.0;
  std::string advice = {};  ///< what follows from it; empty = nothing
  Kind kind = Kind::kHard;
  std::string limit_note = {};  ///< "for CONFIRMED"; empty = nothing

  /// Not on its side; NaN always.
  bool Failed() const;
  /// "31 measurements lie on the valve (at least 40): scan slower". Of a gate that failed.
  std::string Sentence() const;
};

/// Adds the sentence of a gate that failed.
void AddIfFailed(const Gate& gate, std::vector<std::string>& failed_gates);

/// Another answer that is this far behind, "far less likely", is never a reason.
inline constexpr double kFarBehind_nats = 50.0;

/// A gate on what a feature of a verdict's model was computed from.
struct FeatureGate {
  std::string feature;
  Gate gate;  ///< its limit is the feature's mean, in the gate's unit, of odds at most
              ///< kFarBehind_nats
};

/// Of the gates, as usual ones, those that failed and whose feature takes something off the
/// probability, the most first. `values` are the model's features. A gate whose feature the model
/// lacks, or weighs the other way round, is none of them.
std::vector<Gate> WeightiestFirst(const VerdictModel& model, std::span<const double> values,
                                  const std::vector<FeatureGate>& gates);

/// The mean of a feature over the answers that a model was fitted to. Throws ContractViolation
/// where it has none of this name.
double MeanOf(const VerdictModel& model, std::string_view feature);

/// The reason of a verdict whose level, probability and failed gates are filled in: its first
/// failed gate; of a CONFIRMED one `confirmed`; else its probability, which is below `least_likely`
/// or what CONFIRMED needs, with the first of the `usual` limits that it misses.
std::string ReasonOf(const Verdict& verdict, double least_likely, const std::string& confirmed,
                     const std::vector<Gate>& usual);

}  // namespace foresight
