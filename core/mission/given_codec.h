#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/sensor/given_cloud.h"

namespace foresight {

/// A line of a given cloud as the mission file keeps it.
struct PackedGivenLine {
  static constexpr std::int64_t kHasIntensity = 1;
  static constexpr std::int64_t kHasTime = 2;

  std::int64_t beams = 0;
  std::int64_t parts = 0;  ///< kHasIntensity and kHasTime, added
  /// Origin (3 floats); of all beams x, then y, then z, intensity (floats), time (doubles);
  /// little-endian, then zlib.
  std::string bytes;
};

/// Fails with kInvalidInput where zlib does. @pre cloud.Check(), a line of it
Result<PackedGivenLine> PackGivenLine(const GivenCloud& cloud, int line);

/// A cloud that is put together from packed lines, which come in the order of their numbers. A line
/// that does not come has no points.
class GivenCloudBuilder {
 public:
  /// Fails with kBadData where the bytes are not what PackGivenLine makes, the line is another
  /// width or has other parts than those before, or the cloud would be too large.
  Status Add(std::int64_t line, const PackedGivenLine& packed);
  GivenCloud Take() { return std::move(cloud_); }

 private:
  Status CheckShape(std::int64_t line, const PackedGivenLine& packed);
  void AppendEmptyLines(int count);

  GivenCloud cloud_;
  std::int64_t parts_ = 0;
};

}  // namespace foresight
