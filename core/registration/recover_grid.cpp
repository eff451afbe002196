#include "core/registration/recover_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/quantile.h"
#include "core/geometry/symmetric_eigen.h"
#include "core/sensor/given_cloud.h"

namespace foresight {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
/// A grid may have so many places a point; one with more was recovered from noise.
constexpr std::size_t kMostPlacesAPoint = 16;
constexpr std::size_t kPlacesToSpare = 100'000;

/// A direction that was measured, with the number of its point.
struct Sight {
  std::size_t point = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Sights of one line, with the angle of each within the line.
struct Line {
  std::vector<Sight> sights;
  std::vector<double> angle_rad;
};

std::vector<Sight> SightsOf(std::span<const Eigen::Vector3d> points,
                            const Eigen::Vector3d& viewpoint) {
  constexpr double kNearest_m = 1e-6;
  std::vector<Sight> sights;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d ray = points[i] - viewpoint;
    const double range = ray.norm();
    if (std::isfinite(range) && range > kNearest_m) sights.push_back({i, ray / range});
  }
  return sights;
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

/// Angle from each sight to the next one: entry i is that from i to i + 1.
std::vector<double> StepsBetween(const std::vector<Sight>& sights) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < sights.size(); ++i)
    steps.push_back(AngleBetween(sights[i - 1].direction, sights[i].direction));
  return steps;
}

/// 0 where there is none.
double Median(std::vector<double> values) {
  return values.empty() ? 0.0 : UpperMedian(std::move(values));
}

/// In (-pi, pi].
double Wrapped(double angle_rad) {
  return std::remainder(angle_rad, kTurn_rad);
}

GridPlaces NoPlaces(std::size_t points) {
  GridPlaces places;
  places.line.assign(points, -1);
  places.beam.assign(points, -1);
  return places;
}

/// Every second place of every second line: no two points are neighbours.
GridPlaces Scatter(std::size_t points, const std::vector<Sight>& sights) {
  GridPlaces places = NoPlaces(points);
  const auto row = static_cast<std::size_t>(
      std::clamp(std::ceil(std::sqrt(static_cast<double>(sights.size()))), 1.0, 10'000.0));
  for (std::size_t i = 0; i < sights.size(); ++i) {
    places.line[sights[i].point] = static_cast<std::int32_t>(2 * (i / row));
    places.beam[sights[i].point] = static_cast<std::int32_t>(2 * (i % row));
  }
  places.beams = static_cast<int>(2 * row);
  places.lines = static_cast<int>(2 * ((sights.size() + row - 1) / row));
  return places;
}

/// The usual angle from a beam to the next one: the mean of the steps that are no gaps.
double StepOf(const std::vector<Line>& lines) {
  std::vector<double> steps;
  for (const Line& line : lines)
    for (std::size_t i = 1; i < line.angle_rad.size(); ++i)
      if (const double step = line.angle_rad[i] - line.angle_rad[i - 1]; step > 0.0)
        steps.push_back(step);
  const double usual = Median(steps);
  double sum = 0.0;
  std::size_t count = 0;
  for (const double step : steps) {
    if (step > 1.5 * usual) continue;
    sum += step;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

void SortByAngle(Line& line) {
  std::vector<std::size_t> order(line.sights.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&line](std::size_t a, std::size_t b) {
    return line.angle_rad[a] < line.angle_rad[b];
  });
  Line sorted;
  for (const std::size_t i : order) {
    sorted.sights.push_back(line.sights[i]);
    sorted.angle_rad.push_back(line.angle_rad[i]);
  }
  line = std::move(sorted);
}

/// Gives each sight of the lines a beam: by its angle, after that of the sight before, and never
/// two the same.
std::optional<GridPlaces> PlaceOnBeams(const std::vector<Line>& lines, std::size_t points,
                                       std::size_t sights) {
  GridPlaces places = NoPlaces(points);
  double first = std::numeric_limits<double>::infinity();
  for (const Line& line : lines)
    for (const double angle : line.angle_rad) first = std::min(first, angle);
  places.step_rad = StepOf(lines);
  if (!(places.step_rad > 1e-6)) return std::nullopt;
  std::int64_t most = 0;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    std::int64_t last = -1;
    for (std::size_t i = 0; i < lines[row].sights.size(); ++i) {
      const auto at = std::llround((lines[row].angle_rad[i] - first) / places.step_rad);
      last = std::max<std::int64_t>(at, last + 1);
      places.line[lines[row].sights[i].point] = static_cast<std::int32_t>(row);
      places.beam[lines[row].sights[i].point] = static_cast<std::int32_t>(last);
      if (last >= GivenCloud::kMostBeams) return std::nullopt;
    }
    most = std::max(most, last);
  }
  places.lines = static_cast<int>(lines.size());
  places.beams = static_cast<int>(most + 1);
  const std::size_t cells = lines.size() * static_cast<std::size_t>(places.beams);
  if (cells > kMostPlacesAPoint * sights + kPlacesToSpare) return std::nullopt;
  return places;
}

/// The way that directions turn from one sight to the next, as the sum of their cross products;
/// jumps are left out.
Eigen::Vector3d TurnOf(const std::vector<Sight>& sights) {
  constexpr double kJumpPerStep = 8.0;
  const std::vector<double> steps = StepsBetween(sights);
  const double jump_rad = kJumpPerStep * Median(steps);
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < sights.size(); ++i)
    if (steps[i - 1] <= jump_rad) turn += sights[i - 1].direction.cross(sights[i].direction);
  return turn;
}

/// That as an axis; nullopt where they turn no way.
std::optional<Eigen::Vector3d> AxisOfTurn(const Eigen::Vector3d& turn) {
  if (!(turn.norm() > 1e-6)) return std::nullopt;
  return turn.normalized();
}

/// Angle of each sight about an axis, in (-pi, pi].
std::vector<double> AnglesAbout(const Eigen::Vector3d& axis, const std::vector<Sight>& sights) {
  const Eigen::Vector3d zero = axis.unitOrthogonal();
  const Eigen::Vector3d ninety = axis.cross(zero);
  std::vector<double> angles;
  angles.reserve(sights.size());
  for (const Sight& sight : sights)
    angles.push_back(std::atan2(sight.direction.dot(ninety), sight.direction.dot(zero)));
  return angles;
}

/// Where angles are not, all round: the widest of these gaps.
struct Gap {
  double middle_rad = 0.0;
  double width_rad = 0.0;
};
Gap WidestGap(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  Gap widest;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles.front() + kTurn_rad;
    if (next - angles[i] > widest.width_rad) widest = {0.5 * (angles[i] + next), next - angles[i]};
  }
  return widest;
}

/// Turns of a spinning lidar whose lasers stand one after the other in the file.
std::optional<std::vector<Line>> SplitTurns(const std::vector<Sight>& sights,
                                            const std::vector<double>& angles,
                                            const Eigen::Vector3d& axis) {
  constexpr double kOneWay = 0.98;  ///< of the steps
  constexpr double kLeastTurns = 1.5;
  std::vector<double> unwrapped = {angles.front()};
  std::size_t forward = 0, backward = 0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double step = Wrapped(angles[i] - unwrapped.back());
    if (step > 0.0) ++forward;
    if (step < 0.0) ++backward;
    unwrapped.push_back(unwrapped.back() + step);
  }
  const double turns = std::abs(unwrapped.back() - unwrapped.front()) / kTurn_rad;
  if (turns < kLeastTurns ||
      static_cast<double>(forward) < kOneWay * static_cast<double>(forward + backward))
    return std::nullopt;
  // A turn begins where the file goes on to the next laser: there the elevation jumps.
  const auto jump_of = [&](double begin) {
    double jump = 0.0;
    for (std::size_t i = 1; i < sights.size(); ++i)
      if (std::floor((unwrapped[i] - begin) / kTurn_rad) !=
          std::floor((unwrapped[i - 1] - begin) / kTurn_rad))
        jump += std::abs(axis.dot(sights[i].direction - sights[i - 1].direction));
    return jump;
  };
  double begin = unwrapped.front() - 1e-9;
  for (const double other : {0.0, std::numbers::pi})
    if (jump_of(other) > jump_of(begin)) begin = other;
  std::vector<Line> lines;
  double turn = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const double now = std::floor((unwrapped[i] - begin) / kTurn_rad);
    if (now != turn) lines.emplace_back();
    turn = now;
    lines.back().sights.push_back(sights[i]);
    lines.back().angle_rad.push_back(unwrapped[i] - begin - turn * kTurn_rad);
  }
  return lines;
}

using Cut = std::vector<std::vector<Sight>>;

/// Lines of a fan that turns by less than half a turn: cut where the angle goes back. Angles grow
/// from the gap's middle on.
Cut CutWhereTheAngleGoesBack(const std::vector<Sight>& sights, const std::vector<double>& angles,
                             const Gap& gap) {
  // Where a thing stands before a wall, and the lidar was not quite at the viewpoint, the angle
  // goes back by a few beams.
  constexpr double kReturn = 0.2;  // of all that is seen
  constexpr double kMostReturn_rad = 0.1;
  const double least = std::min(kMostReturn_rad, kReturn * (kTurn_rad - gap.width_rad));
  std::vector<double> past;  // the gap
  for (const double angle : angles)
    past.push_back(std::remainder(angle - gap.middle_rad - std::numbers::pi, kTurn_rad));
  // A stray return close to the viewpoint lies anywhere: two sights on both sides must say so.
  const auto goes_back = [&](std::size_t i) {
    const double before = i > 1 ? std::min(past[i - 1], past[i - 2]) : past[i - 1];
    const double after = i + 1 < past.size() ? std::max(past[i], past[i + 1]) : past[i];
    return after < before - least;
  };
  Cut lines(1);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (i > 0 && goes_back(i)) lines.emplace_back();
    lines.back().push_back(sights[i]);
  }
  return lines;
}

/// Lines of a fan that turns any far, whose planes have no way in common: cut where the direction
/// goes back to where the line before began.
Cut CutWhereItBeginsAnew(const std::vector<Sight>& sights) {
  constexpr double kLeastReturn_rad = 0.1;
  constexpr double kReturnPerStep = 8.0;
  constexpr double kNearBegin = 0.3;  ///< of the way back
  const std::vector<double> steps = StepsBetween(sights);
  const double least = std::max(kLeastReturn_rad, kReturnPerStep * Median(steps));
  Cut lines(1);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (i > 0 && steps[i - 1] > least &&
        AngleBetween(sights[i].direction, lines.back().front().direction) <
            kNearBegin * steps[i - 1])
      lines.emplace_back();
    lines.back().push_back(sights[i]);
  }
  return lines;
}

/// The plane that a line's directions lie in, turned the way they go; nullopt where they do not
/// say.
std::optional<Eigen::Vector3d> NormalOf(const std::vector<Sight>& line) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < line.size(); ++i)
    normal += line[i - 1].direction.cross(line[i].direction);
  return AxisOfTurn(normal);
}

/// The axis that a scanner turns its plane about: it lies in all of them.
Eigen::Vector3d AxisOf(const std::vector<std::optional<Eigen::Vector3d>>& normals,
                       const Eigen::Vector3d& ahead) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& normal : normals)
    if (normal) sum += *normal * normal->transpose();
  const auto eigen = EigenOf(sum);
  const Eigen::Vector3d axis = eigen.vectors.col(0);
  constexpr double kSamePlane = 1e-4;
  // All lines in one plane: any direction in it will do.
  if (eigen.values[1] < kSamePlane * eigen.values[2]) return ahead;
  return axis.dot(ahead) < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

/// The lines with their angles; nullopt where the sights of a line do not follow each other.
std::optional<std::vector<Line>> SweepsOf(const Cut& cut, const std::vector<Sight>& sights) {
  constexpr std::size_t kLeastLines = 2;
  constexpr std::size_t kLeastPoints = 4;  ///< of the usual line
  if (cut.size() < kLeastLines || sights.size() < kLeastPoints * cut.size()) return std::nullopt;
  std::vector<std::optional<Eigen::Vector3d>> normals;
  for (const std::vector<Sight>& line : cut) normals.push_back(NormalOf(line));
  const Eigen::Vector3d axis = AxisOf(normals, sights.front().direction);
  std::vector<Line> lines;
  std::size_t ordered = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    Line line{cut[i], {}};
    const Eigen::Vector3d normal =
        normals[i].value_or(axis.unitOrthogonal());  // of a single point: any plane
    const Eigen::Vector3d across = normal.cross(axis).normalized();
    double last = -std::numbers::pi;
    for (const Sight& sight : line.sights) {
      // Continued from the point before, so that a fan may be wider than half a turn.
      const double angle = std::atan2(sight.direction.dot(across), sight.direction.dot(axis));
      const double now = line.angle_rad.empty() ? angle : last + Wrapped(angle - last);
      if (now >= last) ++ordered;
      line.angle_rad.push_back(now);
      last = now;
    }
    lines.push_back(std::move(line));
  }
  constexpr double kInOrder = 0.95;
  if (static_cast<double>(ordered) < kInOrder * static_cast<double>(sights.size()))
    return std::nullopt;
  return lines;
}

std::optional<std::vector<Line>> SplitRings(const std::vector<Sight>& sights,
                                            std::span<const std::int32_t> rings) {
  std::vector<Line> lines;
  for (const Sight& sight : sights) {
    const auto ring = static_cast<std::size_t>(rings[sight.point]);
    if (ring >= lines.size()) lines.resize(ring + 1);
    lines[ring].sights.push_back(sight);
  }
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (const Line& line : lines) turn += TurnOf(line.sights);
  const auto axis = AxisOfTurn(turn);
  if (!axis) return std::nullopt;
  for (Line& line : lines) {
    line.angle_rad = AnglesAbout(*axis, line.sights);
    SortByAngle(line);
  }
  return lines;
}

bool AreRings(const std::vector<Sight>& sights, std::span<const std::int32_t> rings,
              std::size_t points) {
  constexpr std::int32_t kMostRings = 1024;
  return rings.size() == points && !sights.empty() &&
         std::all_of(sights.begin(), sights.end(), [&](const Sight& sight) {
           return rings[sight.point] >= 0 && rings[sight.point] < kMostRings;
         });
}

/// How far neighbouring directions of a line are apart, of a grid that the file itself has.
double StepBetween(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& viewpoint,
                   const GridPlaces& places) {
  std::vector<double> steps;
  constexpr std::size_t kEnough = 100'000;
  for (std::size_t i = 1; i < points.size() && steps.size() < kEnough; ++i) {
    if (places.line[i] < 0 || places.line[i] != places.line[i - 1] ||
        places.beam[i] != places.beam[i - 1] + 1)
      continue;
    steps.push_back(AngleBetween((points[i - 1] - viewpoint).normalized(),
                                 (points[i] - viewpoint).normalized()));
  }
  return Median(steps);
}

}  // namespace

GridPlaces RecoverGrid(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& viewpoint,
                       std::span<const std::int32_t> rings) {
  const std::vector<Sight> sights = SightsOf(points, viewpoint);
  constexpr std::size_t kLeast = 16;
  if (sights.size() < kLeast) return Scatter(points.size(), sights);
  const auto with = [&](const std::vector<Line>& lines, GridPlaces::Kind kind) {
    auto places = PlaceOnBeams(lines, points.size(), sights.size());
    if (places) places->kind = kind;
    return places;
  };
  if (AreRings(sights, rings, points.size()))
    if (const auto lines = SplitRings(sights, rings))
      if (auto places = with(*lines, GridPlaces::Kind::kRings)) return *places;
  const auto with_sweeps = [&](const Cut& cut) -> std::optional<GridPlaces> {
    const auto sweeps = SweepsOf(cut, sights);
    return sweeps ? with(*sweeps, GridPlaces::Kind::kSweeps) : std::nullopt;
  };
  if (const auto axis = AxisOfTurn(TurnOf(sights))) {
    const std::vector<double> angles = AnglesAbout(*axis, sights);
    const Gap gap = WidestGap(angles);
    // A fan leaves out what is behind the scanner, a spinning lidar nothing.
    constexpr double kLeastGap_rad = 0.2;
    if (gap.width_rad > kLeastGap_rad) {
      if (auto places = with_sweeps(CutWhereTheAngleGoesBack(sights, angles, gap))) return *places;
    } else if (const auto turns = SplitTurns(sights, angles, *axis)) {
      if (auto places = with(*turns, GridPlaces::Kind::kRings)) return *places;
    }
  }
  if (auto places = with_sweeps(CutWhereItBeginsAnew(sights))) return *places;
  return Scatter(points.size(), sights);
}

GridPlaces GridOfRows(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& viewpoint,
                      std::size_t width) {
  GridPlaces places = NoPlaces(points.size());
  places.kind = GridPlaces::Kind::kRows;
  places.beams = static_cast<int>(width);
  places.lines = static_cast<int>(points.size() / width);
  for (const Sight& sight : SightsOf(points, viewpoint)) {
    places.line[sight.point] = static_cast<std::int32_t>(sight.point / width);
    places.beam[sight.point] = static_cast<std::int32_t>(sight.point % width);
  }
  places.step_rad = StepBetween(points, viewpoint, places);
  return places;
}

Result<GridPlaces> GridOfNumbers(std::span<const Eigen::Vector3d> points,
                                 const Eigen::Vector3d& viewpoint,
                                 std::span<const std::int32_t> line,
                                 std::span<const std::int32_t> beam) {
  GridPlaces places = NoPlaces(points.size());
  places.kind = GridPlaces::Kind::kNumbers;
  const std::vector<Sight> sights = SightsOf(points, viewpoint);
  std::int64_t lines = 0, beams = 0;
  for (const Sight& sight : sights) {
    if (line[sight.point] < 0 || beam[sight.point] < 0)
      return Fail(ErrorCode::kBadData, "point {}: its line or beam is no number of a grid",
                  sight.point);
    lines = std::max<std::int64_t>(lines, line[sight.point] + std::int64_t{1});
    beams = std::max<std::int64_t>(beams, beam[sight.point] + std::int64_t{1});
  }
  const double cells = static_cast<double>(lines) * static_cast<double>(beams);
  if (lines > GivenCloud::kMostLines || beams > GivenCloud::kMostBeams ||
      cells > static_cast<double>(GivenCloud::kMostCells) ||
      cells > 100.0 * static_cast<double>(sights.size()) + 1e7)
    return Fail(ErrorCode::kBadData, "{} lines of {} beams for {} points", lines, beams,
                sights.size());
  places.lines = static_cast<int>(lines);
  places.beams = static_cast<int>(beams);
  std::vector<bool> taken(static_cast<std::size_t>(cells), false);
  for (const Sight& sight : sights) {
    const std::size_t place =
        static_cast<std::size_t>(line[sight.point]) * static_cast<std::size_t>(beams) +
        static_cast<std::size_t>(beam[sight.point]);
    if (taken[place])
      return Fail(ErrorCode::kBadData, "point {}: line {}, beam {} is there twice", sight.point,
                  line[sight.point], beam[sight.point]);
    taken[place] = true;
    places.line[sight.point] = line[sight.point];
    places.beam[sight.point] = beam[sight.point];
  }
  places.step_rad = StepBetween(points, viewpoint, places);
  return places;
}

Result<GridPlaces> GridOfTable(const CloudTable& cloud, std::span<const Eigen::Vector3d> points,
                               const Eigen::Vector3d& viewpoint) {
  const std::size_t count = points.size();
  if (count > 0 && cloud.line.size() == count && cloud.beam.size() == count)
    return GridOfNumbers(points, viewpoint, cloud.line, cloud.beam);
  if (cloud.height > 1 && cloud.width <= GivenCloud::kMostBeams)
    return GridOfRows(points, viewpoint, cloud.width);
  return RecoverGrid(points, viewpoint, cloud.ring);
}

}  // namespace foresight
