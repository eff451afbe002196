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

/// Of the points that follow each other within a line, how many are neighbours on the grid.
double KeptNeighbours(const GridPlaces& places, const std::vector<std::pair<int, int>>& truth) {
  int pairs = 0, kept = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    if (truth[i].first != truth[i - 1].first || truth[i].second != truth[i - 1].second + 1)
      continue;
    ++pairs;
    if (places.line[i] == places.line[i - 1] && places.beam[i] == places.beam[i - 1] + 1) ++kept;
  }
  return static_cast<double>(kept) / pairs;
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

/// What a head brings home: a fan of 270 deg in quarter degrees that is turned about x, with what
/// a box before a wall 2 m ahead shows. Beams to the sides return now and then only, and the lidar
/// stands 30 mm off the axis, so that no single viewpoint is quite where a line was seen from.
Points Head(int lines, std::vector<std::pair<int, int>>* truth) {
  Random random(11);
  Points points;
  for (int line = 0; line < lines; ++line) {
    const double tilt = (0.5 * line - 15.0) * kDegree;
    const Eigen::Vector3d ahead(0.0, std::cos(tilt), std::sin(tilt));
    const Eigen::Vector3d origin = 0.030 * Eigen::Vector3d(0.0, -std::sin(tilt), std::cos(tilt));
    for (int beam = 0; beam <= 1080; ++beam) {
      const double angle = (0.25 * beam - 135.0) * kDegree;
      const bool to_the_side = std::abs(angle) > 50.0 * kDegree;
      if (random.Uniform() < (to_the_side ? 0.97 : 0.1)) continue;
      const Eigen::Vector3d direction =
          std::sin(angle) * Eigen::Vector3d::UnitX() + std::cos(angle) * ahead;
      double range = std::abs(angle) < 8.0 * kDegree ? 0.9 : 2.0 / std::cos(angle);
      if (to_the_side) range = 3.0;
      points.push_back(origin + range * direction);
      truth->emplace_back(line, beam);
    }
  }
  return points;
}

TEST(RecoverGrid, FindsTheLinesOfAHeadWhoseFanReturnsLittleFromItsSides) {
  std::vector<std::pair<int, int>> truth;
  const Points points = Head(60, &truth);
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  EXPECT_EQ(places.kind, GridPlaces::Kind::kSweeps);
  EXPECT_EQ(places.lines, 60);
  EXPECT_LE(places.beams, 1200);
  for (std::size_t i = 0; i < truth.size(); ++i) ASSERT_EQ(places.line[i], truth[i].first) << i;
  // Neighbours stay neighbours, but for a few at the box's edges.
  EXPECT_GT(KeptNeighbours(places, truth), 0.98);
  ExpectNoPlaceTwice(places);
}

TEST(RecoverGrid, AStrayReturnBesideTheViewpointDoesNotCutItsLine) {
  std::vector<std::pair<int, int>> truth;
  Points points = Head(60, &truth);
  for (std::size_t i = 50; i + 50 < points.size(); i += 1000) points[i] *= 0.05;
  // The viewpoint is told to a few centimetres.
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d(0.03, 0.0, -0.04));
  EXPECT_EQ(places.lines, 60);
  for (std::size_t i = 0; i < truth.size(); ++i) ASSERT_EQ(places.line[i], truth[i].first) << i;
}

TEST(RecoverGrid, FindsTheLinesOfASpinningLidarThatSeesItsRobotInASector) {
  std::vector<std::pair<int, int>> all, truth;
  const Points whole = Spinning(16, 900, 0.1, &all);
  Points points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].second >= 100 && all[i].second < 250) continue;
    points.push_back(whole[i]);
    truth.push_back(all[i]);
  }
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  EXPECT_NE(places.kind, GridPlaces::Kind::kScattered);
  EXPECT_GT(KeptNeighbours(places, truth), 0.99);
  ExpectNoPlaceTwice(places);
}

TEST(RecoverGrid, FindsTheTurnsOfASpinningLidarThatLiesOnItsSide) {
  std::vector<std::pair<int, int>> truth;
  Points points = Spinning(16, 900, 0.2, &truth);
  std::vector<std::int32_t> rings;
  for (const auto& [ring, firing] : truth) rings.push_back(ring);
  for (Eigen::Vector3d& point : points) point = Eigen::Vector3d(point.x(), -point.z(), point.y());
  for (const auto& given : {std::vector<std::int32_t>(), rings}) {
    const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero(), given);
    EXPECT_EQ(places.kind, GridPlaces::Kind::kRings);
    EXPECT_NEAR(places.step_rad, 0.4 * kDegree, 1e-6);
    // Where a ring's own numbers tell its line, a turn may begin anywhere within it.
    EXPECT_GT(KeptNeighbours(places, truth), 0.998);
  }
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
