#include <gtest/gtest.h>

#include <memory>

#include "core/fitting/drill/drill_verdict.h"

namespace foresight {
namespace {

/// Rays along z, all onto a box whose front is at 0.95 m, that read `range_m`.
RaySet RaysOntoTheBox(int count, double range_m) {
  RaySet rays;
  for (int i = 0; i < count; ++i)
    rays.rays.push_back({Eigen::Vector3d(0.0005 * i, 0.0, 0.0), Eigen::Vector3d::UnitZ(), range_m});
  return rays;
}

TEST(DrillEvidence, OfAMapIsThatOfTheBeamsBehindIt) {
  DrillCandidate drill;
  SolidPart box;
  box.size_m = {0.1, 0.1, 0.1};
  drill.model.parts = {box};
  drill.base_from_object = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}};
  // The map is smooth there and says 1.2 m; the beams ended on the box.
  RaySet map = RaysOntoTheBox(60, 1.2);
  const DrillEvidence of_map = GatherEvidence(map, drill);
  EXPECT_EQ(of_map.hits, 60);
  EXPECT_EQ(of_map.see_through, 1.0) << "nothing else is known";
  map.beams = std::make_shared<const RaySet>(RaysOntoTheBox(20, 0.95));
  const DrillEvidence of_beams = GatherEvidence(map, drill);
  EXPECT_EQ(of_beams.hits, 20);
  EXPECT_EQ(of_beams.see_through, 0.0);
  EXPECT_EQ(of_beams.inlier_ratio, 1.0);
}

}  // namespace
}  // namespace foresight
