#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// One point as other programs get it.
struct CloudPoint {
  float x = 0.0f;  ///< metres, in the frame the caller chose
  float y = 0.0f;
  float z = 0.0f;
  float intensity = 0.0f;
  std::int32_t line = 0;                                     ///< lidar line
  std::int32_t beam = 0;                                     ///< within the line
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< on the scan's clock
  Rgb8 color;  ///< written only where the file has the fields of an image; black = not in an image
  float confidence = std::numeric_limits<float>::quiet_NaN();  ///< likewise; NaN = in no depth map
};

/// Which fields a file has.
enum class CloudFields {
  kMeasured,   ///< x y z intensity line beam time
  kWithImage,  ///< the same, then rgb and confidence
};

/// Where the points come from; stands in the file's comments, and so does that the unit is metres.
struct CloudOrigin {
  std::string frame;             ///< "robot", "base"; empty = the caller's own, not named
  std::string scan_uuid;         ///< empty = of no scan
  std::int64_t scan_utc_ns = 0;  ///< when the scan began, since 1970
};

/// Binary little-endian PLY; the colour is red, green, blue. Writes the whole file or nothing;
/// fails with kIo.
Status WritePly(const std::filesystem::path& path, std::span<const CloudPoint> points,
                CloudFields fields, const CloudOrigin& origin = {});

/// Binary PCD 0.7, unorganised, identity viewpoint; the colour is PCL's packed `rgb`. Same errors.
Status WritePcd(const std::filesystem::path& path, std::span<const CloudPoint> points,
                CloudFields fields, const CloudOrigin& origin = {});

}  // namespace foresight
