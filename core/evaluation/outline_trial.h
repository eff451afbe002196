#pragma once

#include <cstdint>
#include <vector>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// What an image says along an outline, in pixels of its length by ImageEdges::Piece::response.
class OutlineResponses {
 public:
  /// The limits of the bins; the last one has no end.
  static constexpr double kFrom[] = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0};
  static constexpr std::size_t kBins = std::size(kFrom);

  void Add(double response, double length_px);
  void Add(const OutlineResponses& other);
  double LengthPx() const;
  /// Of the length, the part in a bin.
  double Fraction(std::size_t bin) const;

 private:
  std::vector<double> length_px_ = std::vector<double>(kBins, 0.0);
};

/// Outlines of right fits, and of the fits behind them that point the other way, both as well
/// placed as the program can: what ImageEdges::NatsOf is made from.
struct OutlineTrial {
  int scenes = 0;  ///< with both
  OutlineResponses right, wrong;
};

/// Fits a drill to the returns and the image of a scene of `population` and adds what the image
/// says of both outlines, where they are 4 pixels and more apart. Adds nothing where the fit is not
/// right or none points the other way.
Status AddOutlinesOf(const FitPopulation& population, std::uint64_t seed, const RunContext& context,
                     OutlineTrial& trial);

}  // namespace foresight
