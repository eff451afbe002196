#pragma once

#include <optional>
#include <string>

namespace foresight {

/// An image of a scan that a head has, as it is to come.
struct HeadImageOrder {
  struct Part {
    int left = 0, top = 0, width = 0, height = 0;  ///< px
  };
  std::string scan_id;
  int position = 0;          ///< in the scan, from 0
  int jpeg_quality = 0;      ///< 1 to 100; 0 = lossless, as PNG
  int largest_side_px = 0;   ///< 0 = as it is
  std::optional<Part> part;  ///< of the full image; it is cut out before it is shrunk
};

struct HeadImage {
  std::string bytes;  ///< of a JPEG or PNG file
  double motor_angle_rad = 0.0;
  int full_width = 0, full_height = 0;
  int images = 0;  ///< that the scan has
};

}  // namespace foresight
