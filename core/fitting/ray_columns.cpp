#include "core/fitting/ray_columns.h"

namespace foresight {

void RayColumns::Reserve(std::size_t rays) {
  for (auto* column :
       {&origin_x, &origin_y, &origin_z, &direction_x, &direction_y, &direction_z, &reach_m})
    column->reserve(rays + kLanes);
}

void RayColumns::Add(const double* origin, const double* direction, double reach) {
  origin_x.push_back(origin[0]);
  origin_y.push_back(origin[1]);
  origin_z.push_back(origin[2]);
  direction_x.push_back(direction[0]);
  direction_y.push_back(direction[1]);
  direction_z.push_back(direction[2]);
  reach_m.push_back(reach);
  ++count;
}

void RayColumns::Pad() {
  constexpr double kFar[3] = {1e6, 1e6, 1e6}, kAway[3] = {1.0, 0.0, 0.0};
  const std::size_t rays = count;
  while (Padded() % kLanes != 0) Add(kFar, kAway, 0.0);
  count = rays;
}

}  // namespace foresight
