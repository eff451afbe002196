#pragma once

#include <string>
#include <vector>

#include "core/detection/fit_in_scan.h"
#include "core/detection/pose_difference.h"
#include "core/sensor/camera_frame.h"

namespace foresight {

/// A detection with what it was made from, so that it can be made again.
struct KeptObject {
  std::string uuid;
  std::string name;  ///< the operator's; empty = none
  Detection detection;
  FitSource source = FitSource::kRaw;
  FitOptions options;
  Roi roi;
  DepthOptions depth;                  ///< of sources that need a map
  const CameraFrame* frame = nullptr;  ///< its image; nullptr for kRaw
};

/// One direction in which two halves of a scan place an object, about or along its own axes.
struct HalvesDifference {
  std::string axis;        ///< "along z", "about x"
  double value = 0.0;      ///< of odd against even lines, m or rad
  double predicted = 0.0;  ///< its standard deviation, by what the fits say of theirs
  bool is_turn = false;
  double Sigmas() const { return predicted > 0.0 ? std::abs(value) / predicted : 0.0; }
};

struct HalfFitsLimits {
  double sigmas = 3.5;  ///< amber
  double red_sigmas = 8.0;
  double least_m = 0.001;  ///< smaller differences are no fault, whatever the deviation
  double least_rad = 0.002;
};

/// An object found again in each half of the scan's lines.
struct HalfFits {
  enum class State { kAgree, kDiffer, kDifferFar, kNotSeen };

  State state = State::kNotSeen;
  std::string uuid;
  std::string what;      ///< "4 spokes, rim 240 mm across", or the operator's name
  std::string not_seen;  ///< why it was not compared
  std::vector<HalvesDifference> differences;  ///< the largest by its own deviation first
};

/// "agree", "differ", "differ far", "not seen".
const char* ToString(HalfFits::State state);

/// "along z: 4.1 mm, 3.9 deviations of 1.1 mm".
std::string InWords(const HalvesDifference& difference);

/// The lines with an even number, or an odd one, as a scan of their own: neighbours are neighbours.
RegisteredScan HalfOf(const RegisteredScan& cloud, bool odd);

/// Makes the fit again from even and from odd lines, with the same region, source and options. Two
/// halves of independent measurements differ by twice the deviation of the whole, or by what their
/// own deviations say where that is more: the whole may have looked at an image. A terrain gives
/// one answer a surface. A half in which nothing is found is an answer, too. Fails with kCancelled.
/// Costs two fits, and two depth maps where the source is one.
Result<std::vector<HalfFits>> CheckHalves(const RegisteredScan& cloud, const SensorRig& rig,
                                          const KeptObject& object, const HalfFitsLimits& limits,
                                          const RunContext& context);

}  // namespace foresight
