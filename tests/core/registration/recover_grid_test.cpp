#include "core/registration/recover_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/random.h"

namespace foresight {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
using Points = std::vector<Eigen::Vector3d>;

/// A sphere's shell as a spinning lidar of `rings` lasers sees it: laser after laser, some returns
/// missing. `truth` gets ring and firing of each point.
Points Spinning(int rings, int firings, double missing, std::vector<std::pair<int, int>>* truth) {
  Random random(5);
  Points points;
  for (int ring = 0; ring < rings; ++ring)
    for (int firing = 0; firing < firings; ++firing) {
      if (random.Uniform() < missing) continue;
      const double azimuth = (firing + 0.3) * 2.0 * std::numbers::pi / firings;
      const double elevation = (2.0 - 0.4 * ring) * kDegree;
      const double range = 8.0 + 0.5 * std::sin(3.0 * azimuth);
      points.push_back(range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                               std::cos(elevation) * std::sin(azimuth),
                                               std::sin(elevation)));
      truth->emplace_back(ring, firing);
    }
  return points;
}

/// A fan of `beams` of half a degree, 10 to 170 deg from x, that is tilted about x line by line.
Points Tilting(int lines, int beams, double missing, std::vector<std::pair<int, int>>* truth) {
  Random random(7);
  Points points;
  for (int line = 0; line < lines; ++line)
    for (int beam = 0; beam < beams; ++beam) {
      if (random.Uniform() < missing) continue;
      const double angle = (10.0 + 0.5 * beam) * kDegree, tilt = (0.5 * line - 30.0) * kDegree;
      points.push_back((4.0 + 0.3 * std::sin(9.0 * angle)) *
                       Eigen::Vector3d(std::cos(angle), std::sin(angle) * std::cos(tilt),
                                       std::sin(angle) * std::sin(tilt)));
      truth->emplace_back(line, beam);
    }
  return points;
}

/// How many points stand at their true place, but for a shift of all beams.
std::size_t Right(const GridPlaces& places, const std::vector<std::pair<int, int>>& truth) {
  std::size_t right = 0;
  const int shift = places.beam[0] - truth[0].second;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (places.line[i] == truth[i].first && places.beam[i] == truth[i].second + shift) ++right;
  return right;
}

void ExpectNoPlaceTwice(const GridPlaces& places) {
  std::set<std::pair<int, int>> seen;
  for (std::size_t i = 0; i < places.line.size(); ++i) {
    if (places.line[i] < 0) continue;
    EXPECT_LT(places.line[i], places.lines);
    EXPECT_LT(places.beam[i], places.beams);
    EXPECT_TRUE(seen.insert({places.line[i], places.beam[i]}).second) << "point " << i;
  }
}

TEST(RecoverGrid, FindsTheTurnsOfASpinningLidarWithMissingReturns) {
  std::vector<std::pair<int, int>> truth;
  const Points points = Spinning(16, 900, 0.2, &truth);
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  EXPECT_EQ(places.kind, GridPlaces::Kind::kRings);
  EXPECT_EQ(places.lines, 16);
  EXPECT_NEAR(places.step_rad, 0.4 * kDegree, 1e-6);
  EXPECT_EQ(Right(places, truth), truth.size());
  ExpectNoPlaceTwice(places);
}

TEST(RecoverGrid, FindsTheLinesOfATiltingScannerWithMissingReturns) {
  std::vector<std::pair<int, int>> truth;
  const Points points = Tilting(60, 321, 0.1, &truth);
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  EXPECT_EQ(places.kind, GridPlaces::Kind::kSweeps);
  EXPECT_EQ(places.lines, 60);
  EXPECT_NEAR(places.step_rad, 0.5 * kDegree, 1e-6);
  EXPECT_EQ(Right(places, truth), truth.size());
  ExpectNoPlaceTwice(places);
}

TEST(RecoverGrid, SeesDirectionsFromTheViewpointAndNotFromTheOrigin) {
  std::vector<std::pair<int, int>> truth;
  Points points = Tilting(30, 321, 0.0, &truth);
  const Eigen::Vector3d viewpoint(3.0, -2.0, 1.0);
  for (Eigen::Vector3d& point : points) point += viewpoint;
  EXPECT_EQ(Right(RecoverGrid(points, viewpoint), truth), truth.size());
}

TEST(RecoverGrid, ALaserNumberOfEachPointCountsMoreThanTheirOrder) {
  std::vector<std::pair<int, int>> truth;
  const Points points = Spinning(16, 900, 0.1, &truth);
  // As a spinning lidar fires: all lasers at one angle, then all at the next one.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return truth[a].second < truth[b].second; });
  Points fired;
  std::vector<std::int32_t> rings;
  for (const std::size_t i : order) {
    fired.push_back(points[i]);
    rings.push_back(truth[i].first);
  }
  const GridPlaces places = RecoverGrid(fired, Eigen::Vector3d::Zero(), rings);
  EXPECT_EQ(places.kind, GridPlaces::Kind::kRings);
  EXPECT_EQ(places.lines, 16);
  for (std::size_t i = 0; i < rings.size(); ++i) ASSERT_EQ(places.line[i], rings[i]);
  ExpectNoPlaceTwice(places);
}

TEST(RecoverGrid, PointsWithoutAnOrderGetPlacesWithoutNeighbours) {
  std::vector<std::pair<int, int>> truth;
  Points points = Tilting(40, 321, 0.0, &truth);
  Random random(3);
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1], points[static_cast<std::size_t>(random.Index(static_cast<int>(i)))]);
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  EXPECT_EQ(places.kind, GridPlaces::Kind::kScattered);
  ExpectNoPlaceTwice(places);
  std::set<std::pair<int, int>> taken;
  for (std::size_t i = 0; i < points.size(); ++i) taken.insert({places.line[i], places.beam[i]});
  EXPECT_EQ(taken.size(), points.size());
  for (const auto& [line, beam] : taken) {
    EXPECT_FALSE(taken.contains({line, beam + 1}));
    EXPECT_FALSE(taken.contains({line + 1, beam}));
    EXPECT_FALSE(taken.contains({line + 1, beam + 1}));
  }
}

TEST(RecoverGrid, APointThatIsNotFiniteOrAtTheViewpointHasNoPlace) {
  std::vector<std::pair<int, int>> truth;
  Points points = Tilting(10, 321, 0.0, &truth);
  points[5].x() = std::numeric_limits<double>::quiet_NaN();
  points[9].setZero();
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  EXPECT_EQ(places.line[5], -1);
  EXPECT_EQ(places.line[9], -1);
  EXPECT_EQ(places.line[6], 0);
}

TEST(GridOfNumbers, RefusesAPlaceThatIsTakenTwiceAndAGridThatIsFarTooLarge) {
  const Points points(3, Eigen::Vector3d::UnitX());
  const auto of = [&](std::vector<std::int32_t> line, std::vector<std::int32_t> beam) {
    return GridOfNumbers(points, Eigen::Vector3d::Zero(), line, beam);
  };
  EXPECT_TRUE(of({0, 0, 1}, {0, 1, 0}).has_value());
  EXPECT_NE(of({0, 0, 0}, {0, 1, 1}).error().message.find("twice"), std::string::npos);
  EXPECT_FALSE(of({0, 0, -1}, {0, 1, 1}).has_value());
  EXPECT_FALSE(of({0, 0, 900'000'000}, {0, 1, 90'000}).has_value());
}

}  // namespace
}  // namespace foresight
