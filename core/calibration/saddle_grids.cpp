#include "core/calibration/saddle_grids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <utility>

#include "core/calibration/grid_edges.h"
#include "core/calibration/saddle_points.h"

namespace foresight {
namespace {

constexpr int kNoPoint = -1;
constexpr double kLeastCosine = 0.93;  // 21 deg: edges of a fisheye image bend
constexpr int kTries = 4;              // of the nearest points in a direction

/// The points, and which edge of which other point an edge of each leads to.
class Links {
 public:
  Links(const GrayImage& image, const std::vector<SaddlePoint>& points)
      : image_(image), points_(points), ends_(points.size()) {
    for (std::size_t p = 0; p < points.size(); ++p)
      for (std::size_t edge = 0; edge < 4; ++edge) ends_[p][edge] = Follow(p, edge);
  }

  struct End {
    int point = kNoPoint;
    int edge = 0;  ///< of that point
  };
  /// Nothing where the other point's edge leads elsewhere.
  End Of(int point, int edge) const {
    const End end = Raw(point, edge);
    if (end.point == kNoPoint || Raw(end.point, end.edge).point != point) return {};
    return end;
  }

 private:
  End Raw(int point, int edge) const {
    return ends_[static_cast<std::size_t>(point)][static_cast<std::size_t>(edge)];
  }

  /// The edge of `point` that leads back along `step`; it is light on the other side.
  int EdgeBack(std::size_t point, std::size_t edge, const Eigen::Vector2d& step) const {
    for (std::size_t back = (edge + 1) % 2; back < 4; back += 2)
      if (points_[point].edges[back].dot(step) < -kLeastCosine) return static_cast<int>(back);
    return kNoPoint;
  }

  End Follow(std::size_t from, std::size_t edge) const {
    const SaddlePoint& start = points_[from];
    const Eigen::Vector2d& direction = start.edges[edge];
    std::array<std::pair<double, End>, kTries> nearest;
    nearest.fill({std::numeric_limits<double>::infinity(), {}});
    for (std::size_t to = 0; to < points_.size(); ++to) {
      const Eigen::Vector2d step = points_[to].pixel - start.pixel;
      const double ahead = step.dot(direction);
      if (ahead <= 2.0 || ahead >= nearest.back().first) continue;
      const double length = step.norm();
      if (ahead < kLeastCosine * length || length >= nearest.back().first) continue;
      const int back = EdgeBack(to, edge, step / length);
      if (back == kNoPoint) continue;
      nearest.back() = {length, {static_cast<int>(to), back}};
      for (std::size_t i = nearest.size() - 1; i > 0 && nearest[i].first < nearest[i - 1].first;
           --i)
        std::swap(nearest[i], nearest[i - 1]);
    }
    const int light = edge % 2 == 0 ? 1 : -1;
    for (const auto& [length, end] : nearest) {
      if (end.point == kNoPoint) break;
      const SaddlePoint& other = points_[static_cast<std::size_t>(end.point)];
      if (LightSide(image_, start.pixel, other.pixel,
                    kEdgeContrast * std::min(start.contrast, other.contrast)) == light)
        return end;
    }
    return {};
  }

  const GrayImage& image_;
  const std::vector<SaddlePoint>& points_;
  std::vector<std::array<End, 4>> ends_;
};

/// Points by their place in a grid: (column, row).
using Places = std::map<std::pair<int, int>, int>;

/// All that hangs together with a point, which gets the place (0, 0).
Places PlacesFrom(int start, const Links& links, std::vector<bool>& taken) {
  constexpr std::array<std::pair<int, int>, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  struct Visit {
    int point;
    std::pair<int, int> place;
    int right;  ///< the edge that leads to the next column
  };
  Places places;
  std::queue<Visit> open;
  const auto add = [&](const Visit& visit) {
    if (taken[static_cast<std::size_t>(visit.point)] || places.contains(visit.place)) return;
    taken[static_cast<std::size_t>(visit.point)] = true;
    places[visit.place] = visit.point;
    open.push(visit);
  };
  add({start, {0, 0}, 0});
  while (!open.empty()) {
    const Visit here = open.front();
    open.pop();
    for (int step = 0; step < 4; ++step) {
      const auto next = links.Of(here.point, (here.right + step) % 4);
      if (next.point == kNoPoint) continue;
      const auto [right, down] = kSteps[static_cast<std::size_t>(step)];
      // Of the next point, the edge back is the one opposite to the step.
      add({next.point,
           {here.place.first + right, here.place.second + down},
           (next.edge + 2 - step + 4) % 4});
    }
  }
  return places;
}

/// The largest rectangle of places that are all taken.
std::optional<CornerGrid> LargestRectangle(const Places& places,
                                           const std::vector<SaddlePoint>& points) {
  int left = 0, right = 0, top = 0, bottom = 0;
  for (const auto& [place, point] : places) {
    left = std::min(left, place.first), right = std::max(right, place.first);
    top = std::min(top, place.second), bottom = std::max(bottom, place.second);
  }
  int best_column = 0, best_row = 0, best_columns = 0, best_rows = 0;
  for (int from = top; from <= bottom; ++from) {
    std::vector<int> depth(static_cast<std::size_t>(right - left + 1), 0);
    for (int to = from; to <= bottom; ++to) {
      int run = 0;
      for (int column = left; column <= right; ++column) {
        int& full = depth[static_cast<std::size_t>(column - left)];
        full += places.contains({column, to}) ? 1 : 0;
        run = full == to - from + 1 ? run + 1 : 0;
        const int rows = to - from + 1;
        if (rows < 3 || run < 3 || run * rows <= best_columns * best_rows) continue;
        best_column = column - run + 1, best_row = from, best_columns = run, best_rows = rows;
      }
    }
  }
  if (best_columns == 0) return std::nullopt;
  CornerGrid grid{best_columns, best_rows, {}};
  for (int row = 0; row < best_rows; ++row)
    for (int column = 0; column < best_columns; ++column)
      grid.pixels.push_back(
          points[static_cast<std::size_t>(places.at({best_column + column, best_row + row}))]
              .pixel);
  return grid;
}

}  // namespace

std::vector<CornerGrid> FindSaddleGrids(const GrayImage& image) {
  const std::vector<SaddlePoint> points = FindSaddlePoints(image);
  const Links links(image, points);
  std::vector<bool> taken(points.size(), false);
  std::vector<CornerGrid> grids;
  for (std::size_t point = 0; point < points.size(); ++point) {
    if (taken[point]) continue;
    const Places places = PlacesFrom(static_cast<int>(point), links, taken);
    if (places.size() < 9) continue;
    if (auto grid = LargestRectangle(places, points)) grids.push_back(std::move(*grid));
  }
  return grids;
}

}  // namespace foresight
