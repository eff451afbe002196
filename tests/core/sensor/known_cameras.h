#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/sensor/camera_model.h"

namespace foresight {

struct KnownCamera {
  std::string what;
  CameraModel camera;
  /// Every pixel of the image, and of a margin of half its size all round, has a ray.
  bool shows_all = true;
};

/// Cameras such as exist, of every model, and some at the limits of their model.
inline std::vector<KnownCamera> KnownCameras() {
  const auto camera = [](int width, int height, double f, const Lens& lens) {
    return CameraModel{.width = width,
                       .height = height,
                       .fx = f,
                       .fy = 1.002 * f,
                       .cx = 0.5 * width + 3.2,
                       .cy = 0.5 * height - 4.7,
                       .lens = lens};
  };
  return {
      {"the paper's", camera(1288, 964, 601.0, FisheyeLens{0.9413})},
      {"pinhole", camera(640, 480, 500.0, FisheyeLens{0.0})},
      {"narrow angles, k small", camera(640, 480, 700.0, FisheyeLens{0.06})},
      {"fisheye with k above 1", camera(1000, 750, 330.0, FisheyeLens{1.092}), false},
      {"webcam", camera(640, 480, 620.0, RadialTangentialLens(0.05, -0.1, 1e-3, -5e-4, 0.02))},
      {"barrel", camera(752, 480, 458.0, RadialTangentialLens(-0.2834, 0.0740, 2e-4, 1.8e-5, 0.0))},
      {"wide barrel that ends inside the image",
       camera(1280, 960, 600.0, RadialTangentialLens(-0.3, 0.0, 0.0, 0.0, 0.0)), false},
      {"pincushion", camera(640, 480, 400.0, RadialTangentialLens(0.3, 0.1, -2e-3, 1e-3, 0.01))},
      {"strongly tangential",
       camera(640, 480, 500.0, RadialTangentialLens(-0.1, 0.02, 0.05, -0.04, 0.0))},
      {"telephoto", camera(1920, 1080, 9000.0, RadialTangentialLens(2.0, -800.0, 0.01, 0.0, 3e4))},
      {"equidistant", camera(1280, 960, 400.0, KannalaBrandtLens(0.0, 0.0, 0.0, 0.0)), false},
      {"fisheye", camera(1280, 960, 420.0, KannalaBrandtLens(-0.0127, 0.0201, -0.0124, 0.0017))},
      {"fisheye of 185 deg",
       camera(1280, 960, 263.0, KannalaBrandtLens(0.0154, -0.0047, 0.0007, -1e-4)), false},
      {"fisheye that ends inside the image",
       camera(1280, 960, 600.0, KannalaBrandtLens(-0.1, 0.0, -0.05, 0.0)), false},
      {"EUCM", camera(1280, 960, 380.0, ExtendedUnifiedLens{0.62, 1.08}), false},
      {"EUCM, alpha below a half", camera(1280, 960, 380.0, ExtendedUnifiedLens{0.31, 0.8})},
      {"EUCM, alpha a half", camera(1280, 960, 380.0, ExtendedUnifiedLens{0.5, 1.0})},
      {"EUCM, alpha 1", camera(1280, 960, 600.0, ExtendedUnifiedLens{1.0, 1.3}), false},
      {"EUCM, alpha 0", camera(1280, 960, 600.0, ExtendedUnifiedLens{0.0, 1.0})},
  };
}

}  // namespace foresight
