#pragma once

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {

struct HomeSwitchOptions {
  double edge_rad = 0.0;                             ///< where it switches on, on average
  double hysteresis_rad = RadiansFromDegrees(0.06);  ///< it switches off this far below
  double repeatability_rad = 5.235987755982988e-05;  ///< sigma of each edge, 0.003 deg
};

/// A proximity sensor over a half-plane flag: on for every angle above its edge.
class HomeSwitch {
 public:
  HomeSwitch(const HomeSwitchOptions& options, std::uint64_t seed, double angle_rad);

  /// The flag has moved to `angle_rad`.
  void Update(double angle_rad);
  /// A broken switch is off for ever.
  void Break() { broken_ = true; }
  void Repair() { broken_ = false; }
  bool on() const { return on_ && !broken_; }
  /// It is off although it should be on.
  bool hidden() const { return on_ && broken_; }

 private:
  void DrawNextEdge();

  HomeSwitchOptions options_;
  Random random_;
  bool on_;
  bool broken_ = false;
  double next_edge_rad_ = 0.0;
};

}  // namespace foresight
