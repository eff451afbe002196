#include "hardware/scip/scip_line.h"

#include <algorithm>
#include <limits>

namespace foresight {
namespace {

using Data = ScipLidarOptions::Data;

constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint16_t kNoEcho = 1;

const ScipEcho& EchoOf(const ScipStep& step, Data data) {
  const auto begin = step.echoes.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(step.count);
  if (data == Data::kFarthestEcho) return *(end - 1);
  if (data == Data::kStrongestEcho)
    return *std::max_element(
        begin, end, [](const ScipEcho& a, const ScipEcho& b) { return a.intensity < b.intensity; });
  return *begin;
}

}  // namespace

ScipRequest StreamRequest(const ScipLidarOptions& options) {
  ScipRequest request;
  request.last_step = options.last_step;
  switch (options.data) {
    case Data::kRange:
      request.command = ScipCommand::kStream;
      break;
    case Data::kRangeIntensity:
      request.command = ScipCommand::kStreamIntensity;
      break;
    case Data::kNearestEcho:
    case Data::kStrongestEcho:
    case Data::kFarthestEcho:
      request.command = ScipCommand::kStreamAll;
      break;
  }
  return request;
}

LidarLine LineFromScan(const ScipScan& scan, Data data) {
  LidarLine line;
  line.range_mm.reserve(scan.steps.size());
  const bool intensity = HasIntensity(scan.request.command);
  if (intensity) line.intensity.reserve(scan.steps.size());
  for (const ScipStep& step : scan.steps) {
    const ScipEcho& echo = EchoOf(step, data);
    line.range_mm.push_back(echo.range_mm > kMost ? kNoEcho
                                                  : static_cast<std::uint16_t>(echo.range_mm));
    if (intensity)
      line.intensity.push_back(static_cast<std::uint16_t>(std::min(echo.intensity, kMost)));
  }
  return line;
}

}  // namespace foresight
