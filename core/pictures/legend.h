#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/image.h"
#include "core/pictures/color_map.h"

namespace foresight {

/// What a picture's colours mean, for pictures that leave the program.
struct PictureLegend {
  struct Bar {
    ColorMap map = ColorMap::kTurbo;
    ValueRange range;  ///< in `unit`, low < high
    std::string unit;
    bool open_end = false;  ///< values above the range have its last colour
  };
  /// A colour with a meaning of its own.
  struct Swatch {
    Rgb8 color;
    std::string text;
  };

  std::vector<std::string> lines;  ///< ASCII; shortened where they are wider than the picture
  std::optional<Bar> bar;
  std::vector<Swatch> swatches;
};

/// The picture with the legend on a white strip below it. As wide as the picture, which should have
/// 300 pixels or more.
ColorImage WithLegend(const ColorImage& picture, const PictureLegend& legend);

}  // namespace foresight
