#include "core/sensor/given_cloud.h"

#include <cmath>
#include <cstring>

namespace foresight {
namespace {

template <class T>
bool SameBits(const SharedArray<T>& a, const SharedArray<T>& b) {
  return a.size() == b.size() &&
         (a.data() == b.data() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool IsPlace(const Eigen::Vector3f& point) {
  return point.allFinite() && point.cwiseAbs().maxCoeff() <= GivenCloud::kFarthest_m;
}

}  // namespace

double GivenCloud::FirstTime_s() const {
  for (const double time : time_s)
    if (std::isfinite(time)) return time;
  return 0.0;
}

Status GivenCloud::Check() const {
  if (lines < 1 || beams < 1 || lines > kMostLines || beams > kMostBeams)
    return Fail(ErrorCode::kInvalidInput, "cloud: {} lines of {} beams are not 1 to {} of 1 to {}",
                lines, beams, kMostLines, kMostBeams);
  const std::size_t cells = static_cast<std::size_t>(lines) * static_cast<std::size_t>(beams);
  if (cells > kMostCells)
    return Fail(ErrorCode::kInvalidInput, "cloud: {} lines of {} beams are more than {} places",
                lines, beams, kMostCells);
  const auto fits = [cells](std::size_t size) { return size == 0 || size == cells; };
  if (points.size() != cells || !fits(intensity.size()) || !fits(time_s.size()) ||
      origins.size() != static_cast<std::size_t>(lines))
    return Fail(
        ErrorCode::kInvalidInput,
        "cloud: {} points, {} intensities, {} times and {} origins for {} lines of {} beams",
        points.size(), intensity.size(), time_s.size(), origins.size(), lines, beams);
  for (int line = 0; line < lines; ++line) {
    const bool has_origin = IsPlace(origins[static_cast<std::size_t>(line)]);
    for (int beam = 0; beam < beams; ++beam) {
      const Eigen::Vector3f& point = points[Index(line, beam)];
      if (point.array().isNaN().any()) continue;
      if (!has_origin || !IsPlace(point))
        return Fail(ErrorCode::kInvalidInput,
                    "cloud: line {}, beam {} at ({}, {}, {}) m: its line has no origin, or it is "
                    "beyond {} km",
                    line, beam, point.x(), point.y(), point.z(), 1e-3 * kFarthest_m);
    }
  }
  return {};
}

bool GivenCloud::operator==(const GivenCloud& other) const {
  return lines == other.lines && beams == other.beams && SameBits(points, other.points) &&
         SameBits(intensity, other.intensity) && SameBits(time_s, other.time_s) &&
         SameBits(origins, other.origins);
}

}  // namespace foresight
