#include "hardware/scip/scip_line_troubles.h"

#include <fmt/format.h>

#include <array>

namespace foresight {

void ScipLineTroubles::Note(double time_s, ScipLineTrouble trouble, const std::string& detail) {
  while (!lines_.empty() && lines_.front().time_s < time_s - kMemory_s) lines_.pop_front();
  lines_.push_back({time_s, trouble, detail});
}

std::string ScipLineTroubles::Describe(double time_s) const {
  std::array<int, 4> counts{};
  int all = 0;
  for (const Line& line : lines_) {
    if (line.time_s < time_s - kMemory_s) continue;
    ++counts[static_cast<std::size_t>(line.trouble)];
    ++all;
  }
  auto worst = ScipLineTrouble::kBadSum;
  for (const auto trouble : {ScipLineTrouble::kWrongBeams, ScipLineTrouble::kBadStamp})
    if (counts[static_cast<std::size_t>(trouble)] > counts[static_cast<std::size_t>(worst)])
      worst = trouble;
  const int count = counts[static_cast<std::size_t>(worst)];
  if (count == 0) return "";
  std::string detail;
  for (const Line& line : lines_)
    if (line.trouble == worst) detail = line.detail;
  switch (worst) {
    case ScipLineTrouble::kWrongBeams:
      return fmt::format(
          "{} of {} lines had {} in the last {:.1f} s; check the lidar's model and settings", count,
          all, detail, kMemory_s);
    case ScipLineTrouble::kBadStamp:
      return fmt::format(
          "time stamps {} ({} of {} lines in the last {:.1f} s); switch the lidar "
          "off and on",
          detail, count, all, kMemory_s);
    default:
      return fmt::format(
          "{} of {} lines had a bad check sum in the last {:.1f} s; check the lidar's cable", count,
          all, kMemory_s);
  }
}

}  // namespace foresight
