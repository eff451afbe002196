#pragma once

#include <QString>
#include <vector>

namespace foresight {

/// The paper's mean error of corners in the image (Section III-B: "a mean projection error of 0.360
/// pixels"), and what is bad.
inline constexpr double kPaperError_px = 0.360;
inline constexpr double kHighError_px = 2.0 * kPaperError_px;

/// One thing of a calibration that was compared with its limit.
struct CalibrationCheck {
  enum class Level { kGood, kCaution, kBad };
  Level level = Level::kGood;
  QString text;

  /// Of a value that is the better the smaller it is.
  static Level LevelOf(double value, double good, double bad);
};

/// The worst level of some checks, as a sentence.
CalibrationCheck Summarize(const std::vector<CalibrationCheck>& checks);

}  // namespace foresight
