#include "core/evaluation/plain_cloud.h"

#include <algorithm>

namespace foresight {

PlainCloud PlainCloudOf(const RegisteredScan& scan) {
  PlainCloud cloud;
  for (int line = 0; line < scan.lines; ++line) {
    cloud.viewpoint +=
        scan.origins[static_cast<std::size_t>(line)].cast<double>() / std::max(1, scan.lines);
    for (int beam = 0; beam < scan.beams; ++beam)
      if (scan.Valid(line, beam))
        cloud.points.push_back(scan.points[scan.Index(line, beam)].cast<double>());
  }
  cloud.places = RecoverGrid(cloud.points, cloud.viewpoint);
  return cloud;
}

Result<Detection> FitInPlainCloud(const PlainCloud& cloud, const SensorRig& rig, const Roi& roi,
                                  const FitOptions& options, const RunContext& context) {
  const auto rays_of = [&](const Roi& region, BoxRays box_rays) {
    return RaysInCloud(cloud.points, cloud.places, cloud.viewpoint, rig, region, {}, box_rays);
  };
  return FitInRegion(rays_of, {}, roi, options, context);
}

}  // namespace foresight
