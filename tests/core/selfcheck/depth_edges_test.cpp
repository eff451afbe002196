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

/// Five lines, each 0.01 rad above the one before, of a surface at 2 m that ends one beam further
/// on with each of them.
RegisteredScan SlantingEnd() {
  RegisteredScan cloud;
  cloud.lines = 5;
  cloud.beams = 20;
  for (int line = 0; line < cloud.lines; ++line) {
    cloud.origins.push_back(Eigen::Vector3f::Zero());
    for (int beam = 0; beam < cloud.beams; ++beam) {
      const float range = beam < 8 + line ? 2.0f : 4.0f;
      const float across = 0.005f * static_cast<float>(beam);
      const float up = 0.01f * static_cast<float>(line);
      cloud.range_m.push_back(range);
      cloud.points.push_back(range * Eigen::Vector3f(across, up, 1.0f).normalized());
    }
  }
  return cloud;
}

TEST(FindDepthEdges, SaysWhichWayAnEdgeRuns) {
  const auto edges = FindDepthEdges(SlantingEnd(), DepthEdgeOptions());
  ASSERT_EQ(edges.size(), 5u);
  for (const DepthEdge& edge : edges)
    EXPECT_NEAR(edge.along.x() / edge.along.y(), 0.5, 0.02);  // a beam, 0.005, a line, 0.01
  RegisteredScan alone = SlantingEnd();
  alone.lines = 1;
  EXPECT_TRUE(FindDepthEdges(alone, DepthEdgeOptions()).empty()) << "no other line shows it";
}

}  // namespace
}  // namespace foresight
