#include "core/mapping/point_pyramid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/base/random.h"

namespace foresight {
namespace {

/// A floor of 10 m x 10 m with a wall at x = 10; the tag is the point's number.
std::vector<TaggedPoint> Room(std::size_t count) {
  Random random(7);
  std::vector<TaggedPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool wall = i % 3 == 0;
    points[i].position =
        Eigen::Vector3d(wall ? 10.0 : 10.0 * random.Uniform(), 10.0 * random.Uniform(),
                        wall ? 3.0 * random.Uniform() : 0.0)
            .cast<float>();
    points[i].tag = static_cast<std::uint32_t>(i);
  }
  return points;
}

/// From `eye` along +x with an opening of 90 deg, y of the picture = z.
PyramidView LookAlongX(const Eigen::Vector3d& eye) {
  constexpr double kNear = 0.01, kFar = 1000.0;
  PyramidView view;
  view.clip_from_map.setZero();
  view.clip_from_map.row(0) << 0, -1, 0, eye.y();
  view.clip_from_map.row(1) << 0, 0, 1, -eye.z();
  const double a = (kFar + kNear) / (kFar - kNear), b = -2.0 * kFar * kNear / (kFar - kNear);
  view.clip_from_map.row(2) << a, 0, 0, b - a * eye.x();
  view.clip_from_map.row(3) << 1, 0, 0, -eye.x();
  return view;
}

std::set<std::uint32_t> TagsOf(const std::vector<TaggedPoint>& points) {
  std::set<std::uint32_t> tags;
  for (const TaggedPoint& point : points) tags.insert(point.tag);
  return tags;
}

TEST(PointPyramidTest, HoldsEveryPointOnce) {
  const PointPyramid pyramid =
      PointPyramid::Build(Room(100'000), {.leaf_points = 500, .grid = 16}, {}).value();
  EXPECT_EQ(pyramid.size(), 100'000u);
  EXPECT_GT(pyramid.CubeCount(), 100u);
  PyramidView view = LookAlongX({-20.0, 5.0, 1.0});
  view.finest_px = 0.0;
  const auto all = pyramid.Select(view);
  EXPECT_EQ(all.size(), 100'000u);
  EXPECT_EQ(TagsOf(all).size(), 100'000u);
}

TEST(PointPyramidTest, KeepsTheBudgetAndShowsTheWholeCloudCoarsely) {
  const PointPyramid pyramid =
      PointPyramid::Build(Room(200'000), {.leaf_points = 1000, .grid = 32}, {}).value();
  PyramidView view = LookAlongX({-20.0, 5.0, 1.0});
  view.finest_px = 0.0;
  view.budget = 4'000;
  const auto some = pyramid.Select(view);
  EXPECT_EQ(some.size(), 4'000u);
  // In each square metre of the floor that there is something of.
  std::set<std::pair<int, int>> squares;
  for (const TaggedPoint& point : some)
    squares.emplace(static_cast<int>(point.position.x()), static_cast<int>(point.position.y()));
  EXPECT_GE(squares.size(), 100u);
}

TEST(PointPyramidTest, IsCoarseFromAfarAndHasEveryPointThatIsSeenWhenNear) {
  const std::vector<TaggedPoint> room = Room(200'000);
  const PointPyramid pyramid =
      PointPyramid::Build(room, {.leaf_points = 1000, .grid = 32}, {}).value();
  PyramidView far = LookAlongX({-500.0, 5.0, 1.0});
  far.height_px = 500;
  const std::size_t from_afar = pyramid.Select(far).size();
  EXPECT_GT(from_afar, 500u);
  EXPECT_LT(from_afar, 20'000u) << "more would fall on the same pixels";
  // 0.3 m before the wall every point of what is seen of it is there.
  PyramidView near = LookAlongX({9.7, 5.0, 1.5});
  const std::set<std::uint32_t> taken = TagsOf(pyramid.Select(near));
  std::size_t seen = 0;
  for (const TaggedPoint& point : room) {
    const Eigen::Vector4d clip = near.clip_from_map * point.position.cast<double>().homogeneous();
    if ((clip.head<3>().array().abs() > clip.w()).any()) continue;
    ++seen;
    EXPECT_TRUE(taken.contains(point.tag));
  }
  EXPECT_GT(seen, 500u);
  EXPECT_LT(taken.size(), 60'000u) << "what is behind the viewer is not taken";
}

TEST(PointPyramidTest, ABoxKeepsWhatIsInside) {
  const PointPyramid pyramid =
      PointPyramid::Build(Room(50'000), {.leaf_points = 500, .grid = 16}, {}).value();
  PyramidView view = LookAlongX({-20.0, 5.0, 1.0});
  view.finest_px = 0.0;
  view.keep = Eigen::AlignedBox3d(Eigen::Vector3d(2, 2, -1), Eigen::Vector3d(4, 5, 1));
  const auto inside = pyramid.Select(view);
  EXPECT_NEAR(static_cast<double>(inside.size()), 50'000.0 * 2.0 / 3.0 * 0.06, 250.0);
  for (const TaggedPoint& point : inside)
    EXPECT_TRUE(view.keep->contains(point.position.cast<double>()));
}

TEST(PointPyramidTest, CopesWithOnePlaceWithNothingAndWithNaN) {
  std::vector<TaggedPoint> same(5'000);
  for (TaggedPoint& point : same) point.position = {1.0f, 2.0f, 3.0f};
  const PointPyramid heap =
      PointPyramid::Build(same, {.leaf_points = 10, .grid = 4, .most_levels = 8}, {}).value();
  EXPECT_EQ(heap.size(), 5'000u);
  const PointPyramid none = PointPyramid::Build({}, {}, {}).value();
  EXPECT_EQ(none.size(), 0u);
  EXPECT_TRUE(none.Select({}).empty());
  same.resize(3);
  same[1].position.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(PointPyramid::Build(same, {}, {})->size(), 2u);
}

TEST(PointPyramidTest, StopsWhenItIsCancelled) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(PointPyramid::Build(Room(1'000), {}, context).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(PointPyramid::Build({}, {.grid = 3}, {}).error().code, ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace foresight
