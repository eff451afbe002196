#pragma once

#include <cstdint>
#include <string>

namespace foresight {

/// A fit that a head is to make in a scan it has.
struct HeadFitOrder {
  std::string scan_id;
  std::string
      provenance_json;  ///< Provenance (core/mission) with `source`, `fit`, `roi` and `depth`
  /// Which image an image region and a depth map are in, where the station does not have them.
  enum class Image {
    kAsSaid,   ///< the provenance's image_position, and the region's angle
    kNearest,  ///< to the region's angle, which becomes the image's
    kMiddle    ///< nearest to the middle of the scan's scope
  };
  Image image = Image::kAsSaid;
};

/// What came of it.
struct HeadFit {
  std::string detection_json;   ///< as DetectionToJson makes it
  std::string provenance_json;  ///< complete, with the part of the scan that was there
  std::string scan_state;       ///< as ToString(ScanState)
  std::string scan_reason;
  std::int64_t up_bytes = 0;  ///< of the messages that crossed the link, without what carries them
  std::int64_t down_bytes = 0;
};

}  // namespace foresight
