#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/selfcheck/held_out_beams.h"
#include "core/sensor/camera_frame.h"

namespace foresight {

/// What beams that stayed out of a map say of one class of its pixels.
struct HeldOutErrors {
  int beams = 0;
  /// Quantiles of |map - beam|: of the map's error and the beam's own noise. NaN without beams.
  double q50_m = 0.0;
  double q80_m = 0.0;
  double q95_m = 0.0;
  double right = 0.0;  ///< fraction within 50 mm or 1 %
};

using BeamChoice = std::function<bool(const HeldOutBeam&)>;
/// Of the beams that are chosen and where the map has a depth.
HeldOutErrors HeldOutErrorsOf(const std::vector<HeldOutBeam>& beams, const BeamChoice& choice);

/// A class of beams: "2 to 4 m", "at edges".
struct HeldOutClass {
  std::string name;
  HeldOutErrors errors;
};

/// Beams to which the map gave about the same confidence.
struct ConfidenceClass {
  double from = 0.0;
  double to = 0.0;
  int beams = 0;
  double promised = 0.0;  ///< mean confidence
  double right = 0.0;     ///< fraction that was right
  double sigma = 0.0;     ///< of `right`; neighbours are right or wrong together
};

struct DepthCheckOptions {
  int one_in = 10;
  /// Neighbouring beams are right or wrong together: so many count as one.
  double beams_per_measurement = 5.0;
  double least_shortfall = 0.03;  ///< of `right` below what was promised, to be amber
  double red_shortfall = 0.15;
  double sigmas = 3.0;

  Status Check() const;
};

/// How good a depth map is where its mask keeps it, by beams that stayed out of it.
struct DepthCheck {
  enum class State { kGood, kLessThanPromised, kFarLessThanPromised, kNotSeen };

  State state = State::kNotSeen;
  std::string method;
  double image_rad = 0.0;   ///< the motor's angle of the image
  HeldOutErrors all;        ///< where the mask keeps the map
  HeldOutErrors scattered;  ///< by single beams
  HeldOutErrors lines;      ///< by whole lines: pixels as far from a measurement as any
  /// The map's own error, without the noise of the beams that check it: half_maps.h, map_errors.h.
  double map_q50_m = 0.0;
  double map_q80_m = 0.0;
  double map_q95_m = 0.0;
  std::vector<HeldOutClass> by_distance;
  std::vector<HeldOutClass> by_edge;
  /// Whether 0.9 meant 0.9. Empty where the method's confidence is no probability.
  std::vector<ConfidenceClass> by_confidence;
  /// Of the beams that the mask keeps; beams 0 where the confidence is no probability.
  ConfidenceClass promise;
  double kept = 0.0;    ///< fraction of the beams where the mask keeps the map
  int left_out = 0;     ///< beams that stayed out and count
  int not_counted = 0;  ///< all beams that are rejected, or that the camera cannot see
  double seconds = 0.0;

  static constexpr int kLeastBeams = 200;  ///< where the mask keeps the map
  bool TooFewBeams() const { return all.beams < kLeastBeams; }
};

/// "good", "less than promised", "far less than promised", "not seen".
const char* ToString(DepthCheck::State state);

/// Summarises beams that stayed out, single ones and pairs of neighbouring lines.
/// @param noise_m NoiseOfMap's; empty = the map's own error is told by the lines alone
/// @pre all are of one image
DepthCheck SummariseHeldOut(const std::vector<HeldOutBeam>& scattered,
                            const std::vector<HeldOutBeam>& lines,
                            const std::vector<double>& noise_m, DepthMethod method,
                            const DepthCheckOptions& options);

/// Makes three depth maps of an image, one without scattered beams and pairs of whole lines, and
/// two of half the lines, and compares. Held-out beams do not see a wrong calibration of camera
/// against lidar: those that stay in and those that stay out shift together. Fails as HoldOut does,
/// and with kTooFewPoints where no beam lies in the image.
Result<DepthCheck> CheckDepth(const RegisteredScan& cloud, const SensorRig& rig,
                              const CameraFrame& frame, const DepthOptions& depth,
                              const DepthCheckOptions& options, const RunContext& context);

}  // namespace foresight
