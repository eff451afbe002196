#include "ui/viewmodels/calibration_check.h"

#include <QObject>
#include <algorithm>

namespace foresight {

using Level = CalibrationCheck::Level;

Level CalibrationCheck::LevelOf(double value, double good, double bad) {
  if (value <= good) return Level::kGood;
  return value <= bad ? Level::kCaution : Level::kBad;
}

CalibrationCheck Summarize(const std::vector<CalibrationCheck>& checks) {
  if (checks.empty()) return {Level::kBad, QObject::tr("There is no result yet.")};
  const auto worst = std::max_element(
      checks.begin(), checks.end(), [](const auto& a, const auto& b) { return a.level < b.level; });
  switch (worst->level) {
    case Level::kGood:
      return {Level::kGood, QObject::tr("Good: every limit is met.")};
    case Level::kCaution:
      return {Level::kCaution, QObject::tr("Usable with care: %1").arg(worst->text)};
    case Level::kBad:
      break;
  }
  return {Level::kBad, QObject::tr("Not good enough: %1").arg(worst->text)};
}

}  // namespace foresight
