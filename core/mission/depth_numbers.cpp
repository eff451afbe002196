#include "core/mission/depth_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/base/contract.h"
#include "core/base/sha256.h"

namespace foresight {
namespace {

void Add(int number, Sha256& hash) {
  hash.Add({reinterpret_cast<const char*>(&number), sizeof number});
}

template <class T>
void Add(const Image<T>& image, Sha256& hash) {
  Add(image.width(), hash);
  Add(image.height(), hash);
  std::vector<T> row(static_cast<std::size_t>(image.width()));
  for (int y = 0; y < image.height(); ++y) {
    std::copy_n(image.row(y), row.size(), row.begin());
    if constexpr (std::is_floating_point_v<T>)
      for (T& value : row)
        if (std::isnan(value)) value = std::numeric_limits<T>::quiet_NaN();
    hash.Add({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(T)});
  }
}

}  // namespace

std::string DigestOf(const DenseDepth& dense, const MaskImage& mask) {
  Sha256 hash;
  Add(dense.depth_m, hash);
  Add(dense.confidence, hash);
  Add(mask, hash);
  return hash.Hex();
}

DepthStatistics StatisticsOf(const DenseDepth& dense, const MaskImage& mask) {
  FORESIGHT_EXPECTS(mask.SameSize(dense.depth_m), "a mask has the size of its depth map");
  DepthStatistics statistics;
  std::vector<float> depths;
  depths.reserve(dense.depth_m.size());
  for (std::size_t i = 0; i < dense.depth_m.size(); ++i) {
    const float depth = dense.depth_m.values()[i];
    if (!std::isfinite(depth)) continue;
    depths.push_back(depth);
    if (mask.values()[i] == 0) ++statistics.masked_pixels;
  }
  statistics.valid_pixels = static_cast<std::int64_t>(depths.size());
  std::sort(depths.begin(), depths.end());
  constexpr std::array<double, 5> kQuantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
  for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
    const double at = kQuantiles[i] * (static_cast<double>(depths.size()) - 1.0);
    statistics.depth_quantiles_m[i] = depths.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                     : depths[static_cast<std::size_t>(at + 0.5)];
  }
  statistics.largest_confidence = dense.max_confidence;
  return statistics;
}

}  // namespace foresight
