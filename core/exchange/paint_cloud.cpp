#include "core/exchange/paint_cloud.h"

#include <cmath>

namespace foresight {

void PaintCloud(std::span<CloudPoint> points, const CameraFrame& frame, const DepthResult& depth) {
  const Image<std::int32_t> grid = GridOf(depth.samples, true);
  for (CloudPoint& point : points) {
    if (!std::isnan(point.confidence) || !grid.Contains(point.beam, point.line)) continue;
    const std::int32_t index = grid(point.beam, point.line);
    if (index < 0) continue;
    const AlignedSample& sample = depth.samples.samples[static_cast<std::size_t>(index)];
    const int x = static_cast<int>(std::lround(sample.u));
    const int y = static_cast<int>(std::lround(sample.v));
    if (!frame.image.Contains(x, y) || !depth.dense.confidence.Contains(x, y)) continue;
    point.color = frame.image(x, y);
    point.confidence = depth.dense.confidence(x, y);
  }
}

}  // namespace foresight
