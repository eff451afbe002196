#include "core/selfcheck/flat_cells.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/random.h"
#include "core/geometry/plane.h"

namespace foresight {
namespace {

/// Neighbouring lines that were taken while the head moved one way.
struct LineBlock {
  int first = 0;
  int count = 0;
  double motor_rad = 0.0;  ///< in the middle
  double speed_rad_s = 0.0;
};

struct LineMotion {
  double motor_rad = 0.0;
  double speed_rad_s = 0.0;  ///< NaN where the track does not say
};

LineMotion MotionOf(const LidarLine& line, const MotorTrack& track, const LidarModel& lidar) {
  constexpr double kStep_s = 0.01;
  const double middle_s = line.time_s + lidar.BeamTime(lidar.beams / 2);
  return {
      track.AngleAt(middle_s),
      (track.AngleAt(middle_s + kStep_s) - track.AngleAt(middle_s - kStep_s)) / (2.0 * kStep_s)};
}

std::vector<LineBlock> BlocksOf(const Scan& scan, const FlatCellOptions& options) {
  constexpr int kLeastLines = 3, kMostLines = 40;
  std::vector<LineMotion> motions;
  for (const LidarLine& line : scan.lines)
    motions.push_back(MotionOf(line, scan.track, scan.rig.lidar));
  const auto moves = [&](const LineMotion& m) {
    return std::abs(m.speed_rad_s) >= options.least_speed_rad_s;
  };
  std::vector<LineBlock> blocks;
  const int lines = static_cast<int>(motions.size());
  for (int first = 0; first < lines;) {
    const LineMotion& begin = motions[static_cast<std::size_t>(first)];
    if (!moves(begin)) {
      ++first;
      continue;
    }
    LineBlock block{first, 0, 0.0, 0.0};
    for (int i = first; i < lines && block.count < kMostLines; ++i) {
      const LineMotion& motion = motions[static_cast<std::size_t>(i)];
      if (!moves(motion) || motion.speed_rad_s * begin.speed_rad_s < 0.0) break;
      if (block.count >= kLeastLines &&
          std::abs(motion.motor_rad - begin.motor_rad) >= options.lines_rad)
        break;
      block.motor_rad += motion.motor_rad;
      block.speed_rad_s += motion.speed_rad_s;
      ++block.count;
    }
    first += block.count;
    if (block.count < kLeastLines) continue;
    block.motor_rad /= block.count;
    block.speed_rad_s /= block.count;
    blocks.push_back(block);
  }
  return blocks;
}

std::optional<FlatCell> CellAt(const Scan& scan, const RegisteredScan& cloud,
                               const LineBlock& block, int first_beam,
                               const FlatCellOptions& options) {
  std::vector<Eigen::Vector3d> points;
  FlatCell cell;
  cell.center.setZero();
  for (int line = block.first; line < block.first + block.count; ++line)
    for (int beam = first_beam; beam < first_beam + options.beams; ++beam) {
      if (!cloud.Valid(line, beam)) continue;
      points.push_back(cloud.points[cloud.Index(line, beam)].cast<double>());
      cell.center += points.back();
    }
  cell.points = static_cast<int>(points.size());
  if (cell.points < options.least_filled * block.count * options.beams) return std::nullopt;
  const auto plane = FitPlane(points);
  if (!plane) return std::nullopt;
  cell.center /= cell.points;
  double squares = 0.0;
  for (const Eigen::Vector3d& point : points) squares += std::pow(plane->Distance(point), 2);
  cell.rms_m = std::sqrt(squares / (cell.points - 3));
  if (cell.rms_m > options.most_rms_m) return std::nullopt;

  cell.plate_rad = scan.rig.angle_correction.PlateAngle(block.motor_rad);
  cell.speed_rad_s = block.speed_rad_s;
  const auto head_from_lidar = scan.rig.HeadFromLidar();
  const auto head_from_base = HeadFromBase(cell.plate_rad);
  cell.in_head = head_from_base * cell.center - head_from_lidar.translation();
  cell.direction =
      head_from_lidar.Rotate(scan.rig.lidar.BeamDirection(first_beam + options.beams / 2));
  const Eigen::Vector3d to_lidar = head_from_base.Inverse().Rotate(-cell.in_head);
  cell.normal = plane->normal.dot(to_lidar) < 0.0 ? Eigen::Vector3d(-plane->normal) : plane->normal;
  if (cell.normal.dot(to_lidar.normalized()) < options.least_incidence) return std::nullopt;
  return cell;
}

/// The plane of some cells, each weighted by its points, and how wide they spread in it.
struct PlaneOfCells {
  Plane plane;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double extent_m = 0.0;  ///< rms, in the narrower direction
};

std::optional<PlaneOfCells> FitCells(const std::vector<FlatCell>& cells,
                                     const std::vector<std::size_t>& chosen) {
  if (chosen.size() < 3) return std::nullopt;
  PlaneOfCells fit;
  double weight = 0.0;
  for (const std::size_t i : chosen) {
    fit.center += cells[i].points * cells[i].center;
    weight += cells[i].points;
  }
  fit.center /= weight;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::size_t i : chosen) {
    const Eigen::Vector3d off = cells[i].center - fit.center;
    moments += cells[i].points / weight * off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  fit.plane.normal = solver.eigenvectors().col(0);
  if (fit.plane.normal.dot(cells[chosen.front()].normal) < 0.0) fit.plane.normal *= -1.0;
  fit.plane.offset = fit.plane.normal.dot(fit.center);
  fit.extent_m = std::sqrt(std::max(0.0, solver.eigenvalues()[1]));
  return fit;
}

class PlaneSearch {
 public:
  PlaneSearch(const std::vector<FlatCell>& cells, const CoplanarOptions& options)
      : cells_(cells), options_(options), random_(options.seed), free_(cells.size(), true) {}

  std::vector<CoplanarCells> Run() {
    std::vector<CoplanarCells> planes;
    while (static_cast<int>(planes.size()) < options_.most_planes) {
      const auto best = BestPlane();
      if (!best) break;
      for (const std::size_t i : best->cells) free_[i] = false;
      planes.push_back(*best);
    }
    return planes;
  }

 private:
  std::vector<std::size_t> CellsNear(const Plane& plane, double distance_m) const {
    std::vector<std::size_t> near;
    const double least_cosine = std::cos(options_.normals_rad);
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (free_[i] && std::abs(plane.Distance(cells_[i].center)) < distance_m &&
          cells_[i].normal.dot(plane.normal) > least_cosine)
        near.push_back(i);
    return near;
  }

  std::optional<PlaneOfCells> Guess(std::size_t seed) const {
    const FlatCell& cell = cells_[seed];
    const Plane plane{cell.normal, cell.normal.dot(cell.center)};
    std::vector<std::size_t> near = CellsNear(plane, 2.0 * options_.distance_m);
    std::erase_if(near, [&](std::size_t i) {
      return (cells_[i].center - cell.center).norm() > options_.near_m;
    });
    return FitCells(cells_, near);
  }

  std::optional<CoplanarCells> BestPlane() {
    std::vector<std::size_t> seeds;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (free_[i]) seeds.push_back(i);
    if (static_cast<int>(seeds.size()) < options_.least_cells) return std::nullopt;
    std::optional<CoplanarCells> best;
    for (int trial = 0; trial < options_.trials; ++trial) {
      auto fit =
          Guess(seeds[static_cast<std::size_t>(random_.Index(static_cast<int>(seeds.size())))]);
      std::vector<std::size_t> members;
      for (int round = 0; round < 2 && fit; ++round) {
        members = CellsNear(fit->plane, options_.distance_m);
        fit = FitCells(cells_, members);
      }
      if (!fit || static_cast<int>(members.size()) < options_.least_cells ||
          fit->extent_m < options_.least_extent_m)
        continue;
      if (!best || members.size() > best->cells.size())
        best = CoplanarCells{fit->plane.normal, fit->center, members};
    }
    return best;
  }

  const std::vector<FlatCell>& cells_;
  const CoplanarOptions& options_;
  Random random_;
  std::vector<bool> free_;
};

}  // namespace

std::vector<FlatCell> FindFlatCells(const Scan& scan, const RegisteredScan& cloud,
                                    const FlatCellOptions& options) {
  std::vector<FlatCell> cells;
  for (const LineBlock& block : BlocksOf(scan, options))
    for (int beam = 0; beam + options.beams <= cloud.beams; beam += options.beams)
      if (const auto cell = CellAt(scan, cloud, block, beam, options)) cells.push_back(*cell);
  return cells;
}

std::vector<CoplanarCells> FindCoplanarCells(const std::vector<FlatCell>& cells,
                                             const CoplanarOptions& options) {
  return PlaneSearch(cells, options).Run();
}

}  // namespace foresight
