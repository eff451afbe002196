#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/shared_array.h"

namespace foresight {

/// The motor's reported angle at a time on the scan's clock.
struct MotorSample {
  double time_s = 0.0;
  double angle_rad = 0.0;
  bool operator==(const MotorSample&) const = default;
};

/// What the encoder said during a scan, in time order. Copies share the samples.
class MotorTrack {
 public:
  MotorTrack() = default;
  /// Fails with kBadData when a time is not finite or does not increase, or an angle is not finite.
  static Result<MotorTrack> FromSamples(std::vector<MotorSample> samples);

  /// Appends; a sample that is not later than the last one is dropped.
  void Add(const MotorSample& sample);

  std::span<const MotorSample> samples() const { return samples_.span(); }
  bool empty() const { return samples_.empty(); }

  /// The motor's angle at a time: a straight line fitted to the samples around it, which averages
  /// the encoder's steps (0.02 deg) away. NaN where the track has no sample within kMaxGap_s on
  /// each side.
  double AngleAt(double time_s) const;

  static constexpr double kWindow_s = 0.02;  ///< half width of the fit
  static constexpr double kMaxGap_s = 0.1;

  bool operator==(const MotorTrack&) const = default;

 private:
  SharedArray<MotorSample> samples_;
};

/// Where the plate really is when the motor reports an angle: A_theta of Eq. (4)-(5). Between its
/// knots a natural cubic spline of the difference, beyond them the difference of the end knot.
class AngleCorrection {
 public:
  struct Knot {
    double motor_rad = 0.0;
    double plate_rad = 0.0;
    bool operator==(const Knot&) const = default;
  };

  AngleCorrection() = default;  ///< the plate is where the motor says
  /// Fails with kInvalidOptions unless motor_rad increases strictly and all values are finite.
  static Result<AngleCorrection> FromKnots(std::vector<Knot> knots);

  double PlateAngle(double motor_rad) const;
  std::span<const Knot> knots() const { return knots_; }

  bool operator==(const AngleCorrection& other) const { return knots_ == other.knots_; }

 private:
  std::vector<Knot> knots_;
  std::vector<double> curvature_;  ///< second derivative of the difference at each knot
};

}  // namespace foresight
