#pragma once

#include <cstdint>

namespace foresight {

/// Seeded random numbers that are the same on every platform (xoshiro256++, seeded by splitmix64).
/// The standard's distributions differ between libraries, so they are not used for anything
/// recorded.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// A generator for one purpose of one seed: independent of how often the others were drawn from.
  Random(std::uint64_t seed, std::uint64_t stream);

  std::uint64_t Next();
  /// Uniform in [0, 1).
  double Uniform();
  /// Uniform in [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// True in `fraction` of the draws.
  bool Chance(double fraction) { return Uniform() < fraction; }
  /// Uniform integer in [0, count); count > 0.
  int Index(int count);
  /// Normal with mean 0 and standard deviation 1.
  double Normal();
  /// Poisson with the given mean (normal approximation above 50).
  int Poisson(double mean);

 private:
  std::uint64_t state_[4];
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace foresight
