#include "core/simulation/pixel_rays.h"

#include <algorithm>
#include <cmath>

#include "core/sensor/fisheye_rays.h"

namespace foresight {
namespace {

constexpr int kPiecesOfRadius = 512;

/// The cubic through values at t = 0, 1/3, 2/3 and 1.
std::array<double, 4> CubicThrough(const std::array<double, 4>& v) {
  return {v[0], (-11.0 * v[0] + 18.0 * v[1] - 9.0 * v[2] + 2.0 * v[3]) / 2.0,
          (18.0 * v[0] - 45.0 * v[1] + 36.0 * v[2] - 9.0 * v[3]) / 2.0,
          (-9.0 * v[0] + 27.0 * v[1] - 27.0 * v[2] + 9.0 * v[3]) / 2.0};
}

}  // namespace

PixelRays::PixelRays(const CameraModel& camera) : camera_(camera) {
  const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens);
  if (fisheye == nullptr) return;
  const double right = std::max(camera.cx + 1.0, camera.width - camera.cx) / camera.fx;
  const double down = std::max(camera.cy + 1.0, camera.height - camera.cy) / camera.fy;
  const double largest_q = right * right + down * down;
  std::vector<Piece> pieces(kPiecesOfRadius);
  for (int i = 0; i < kPiecesOfRadius; ++i) {
    std::array<double, 4> s{}, c{};
    for (std::size_t j = 0; j < 4; ++j) {
      const double q = largest_q * (i + static_cast<double>(j) / 3.0) / kPiecesOfRadius;
      const double r = std::sqrt(q);
      const auto ray = FisheyeRay(fisheye->k, r, 0.0);
      if (!ray) return;  // an image that reaches beyond the lens
      // s is smooth in q, also at the centre, where the quotient is not.
      s[j] = r > 1e-4 ? ray->x() / r : ray->z() * (1.0 + fisheye->k * fisheye->k * q / 3.0);
      c[j] = ray->z();
    }
    pieces[static_cast<std::size_t>(i)] = {CubicThrough(s), CubicThrough(c)};
  }
  pieces_per_q_ = kPiecesOfRadius / largest_q;
  pieces_ = std::move(pieces);
}

}  // namespace foresight
