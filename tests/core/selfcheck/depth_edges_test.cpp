#include "core/selfcheck/depth_edges.h"

#include <gtest/gtest.h>

#include <cmath>

namespace foresight {
namespace {

/// One line: ten beams on a smooth surface at 5 m, then ten on a rough one at 8 m.
RegisteredScan SmoothBeforeRough() {
  RegisteredScan cloud;
  cloud.lines = 1;
  cloud.beams = 20;
  cloud.origins = {Eigen::Vector3f::Zero()};
  for (int beam = 0; beam < cloud.beams; ++beam) {
    const float range = beam < 10 ? 5.0f : (beam % 2 == 0 ? 8.6f : 7.4f);
    const float angle = 0.003f * static_cast<float>(beam);
    cloud.range_m.push_back(range);
    cloud.points.push_back(range * Eigen::Vector3f(std::sin(angle), 0.0f, std::cos(angle)));
  }
  return cloud;
}

TEST(FindDepthEdges, OfImportedScansTheFarSideMayBeRough) {
  const RegisteredScan cloud = SmoothBeforeRough();
  EXPECT_TRUE(FindDepthEdges(cloud, DepthEdgeOptions()).empty());
  const auto edges = FindDepthEdges(cloud, DepthEdgeOptions::OfImported());
  ASSERT_EQ(edges.size(), 1u) << "the rough side has no edges of its own";
  // Half a step beyond the last beam of the near surface.
  EXPECT_NEAR(std::atan2(edges[0].point.x(), edges[0].point.z()), 0.003 * 9.5, 1e-4);
}

}  // namespace
}  // namespace foresight
