#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "tests/support/sample_grids.h"

namespace foresight {

/// A room-like view to measure with: a slanted wall, a nearer box, noise in depth and image.
struct Room {
  AlignedSamples samples;
  ColorImage guide;
};

inline bool OnTheBox(double x, double y) {
  return x > 0.34 && x < 0.66 && y > 0.33 && y < 0.79;
}

/// Metres along z at a pixel of a room of width x height pixels.
inline double TrueRoomDepth(double u, double v, int width, int height) {
  const double x = u / width;
  return OnTheBox(x, v / height) ? 1.2 : 2.0 + 0.64 * x;
}

inline DepthImage TrueRoom(int width, int height) {
  DepthImage truth_m(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      truth_m(u, v) = static_cast<float>(TrueRoomDepth(u, v, width, height));
  return truth_m;
}

/// One sample every step_u x step_v pixels: 4 x 12 is 2.1 %, 4 x 5 is 5 %.
inline Room MakeRoom(int width, int height, int step_u, int step_v) {
  Random random(1);
  Room room;
  room.samples = SamplesOnLattice(width, height, step_u, step_v, [](int, int) { return 1.0; });
  // Real scans lie between the pixels and the rows; samples on a lattice would leave most rows
  // empty.
  for (AlignedSample& s : room.samples.samples) {
    s.u =
        std::clamp(s.u + static_cast<float>(random.Normal()), 0.0f, static_cast<float>(width - 1));
    s.v =
        std::clamp(s.v + static_cast<float>(random.Normal()), 0.0f, static_cast<float>(height - 1));
    s.depth_m =
        static_cast<float>(TrueRoomDepth(s.u, s.v, width, height) + 0.010 * random.Normal());
    s.point *= s.depth_m;
  }
  room.guide = ColorImage(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const bool box = OnTheBox(static_cast<double>(u) / width, static_cast<double>(v) / height);
      const double value = (box ? 170.0 : 90.0) + 20.0 * std::sin(0.05 * u) + 4.0 * random.Normal();
      const auto level = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
      room.guide(u, v) = {level, level, level};
    }
  return room;
}

}  // namespace foresight
