#include "core/fitting/terrain/block_lattice.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

using Rows = Eigen::Matrix<double, 2, 4>;  // of a place by origin (2) and step between blocks (2)

constexpr int kMinBlocks = 5;
constexpr double kWellPlaced_m = 0.022;  // deviation in the worse direction
constexpr double kLeastFraction = 0.8;   // of the well placed blocks that stand in rows
constexpr double kMaxGap_sigmas = 3.0;
constexpr double kLeastPitch = 0.90, kMostPitch = 1.35;  // sides of a block
constexpr double kPitchStep_m = 0.003;
constexpr double kFirstJitter_m = 0.010;
constexpr double kTurnJitter_rad = RadiansFromDegrees(1.0);
// Beyond the last one rows say less of a block than any edge of its own.
constexpr std::array kJitters_m = {0.003, 0.004, 0.006, 0.008, 0.010, 0.013, 0.016};
constexpr int kLatticeRounds = 6;

Rows RowsOf(const Eigen::Vector2d& cell) {
  Rows rows;
  rows << 1.0, 0.0, cell.x(), -cell.y(), 0.0, 1.0, cell.y(), cell.x();
  return rows;
}

Eigen::Matrix2d WithJitter(const Eigen::Matrix2d& covariance, double jitter_m) {
  return covariance + jitter_m * jitter_m * Eigen::Matrix2d::Identity();
}

bool WellPlaced(const BlockPlace& block) {
  const double mean = 0.5 * block.covariance.trace();
  const double worst =
      mean + std::sqrt(std::max(0.0, mean * mean - block.covariance.determinant()));
  return worst < kWellPlaced_m * kWellPlaced_m;
}

/// Of directions that are the same after a quarter turn.
double MeanYaw(std::span<const BlockPlace> blocks) {
  std::complex<double> sum = 0.0;
  for (const BlockPlace& block : blocks)
    sum += std::polar(1.0 / (block.yaw_sigma_rad * block.yaw_sigma_rad), 4.0 * block.yaw_rad);
  return 0.25 * std::arg(sum);
}

/// A lattice that is being fitted.
struct Fit {
  Eigen::Vector4d rows = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
  double jitter_m = kFirstJitter_m;
  std::vector<Eigen::Vector2d> cells;  ///< whole numbers, of each block

  Eigen::Vector2d Node(std::size_t i) const { return RowsOf(cells[i]) * rows; }
};

/// Pitch and phase by trying; leaves the cells of all blocks in `fit`.
void SearchCells(std::span<const BlockPlace> blocks, const std::vector<bool>& used, double side_m,
                 Fit& fit) {
  const double yaw = MeanYaw(blocks);
  double least = 1e300;
  for (const double turn_deg : {0.0, -1.5, 1.5, -3.0, 3.0}) {
    const Eigen::Rotation2Dd along(-(yaw + RadiansFromDegrees(turn_deg)));
    for (double pitch = kLeastPitch * side_m; pitch < kMostPitch * side_m; pitch += kPitchStep_m) {
      Eigen::Vector2d phase;
      for (int axis = 0; axis < 2; ++axis) {
        std::complex<double> sum = 0.0;
        for (std::size_t i = 0; i < blocks.size(); ++i)
          if (used[i])
            sum += std::polar(1.0, 2.0 * std::numbers::pi * (along * blocks[i].at)[axis] / pitch);
        phase[axis] = std::arg(sum) / (2.0 * std::numbers::pi);
      }
      double cost = 0.0;
      std::vector<Eigen::Vector2d> cells;
      for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Eigen::Vector2d at = along * blocks[i].at / pitch - phase;
        cells.emplace_back(at.array().round());
        const double variance = WithJitter(blocks[i].covariance, fit.jitter_m).trace() / 2.0;
        if (used[i])
          cost += std::log1p(pitch * pitch * (at - cells.back()).squaredNorm() / variance / 4.0);
      }
      if (cost >= least) continue;
      least = cost;
      fit.cells = std::move(cells);
    }
  }
}

/// Robust least squares over origin and step for a given jitter.
void SolveRows(std::span<const BlockPlace> blocks, const std::vector<bool>& used, Fit& fit) {
  for (int round = 0; round < kLatticeRounds; ++round) {
    Eigen::Matrix4d information = 1e-6 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!used[i]) continue;
      const Rows rows = RowsOf(fit.cells[i]);
      Eigen::Matrix2d weight = WithJitter(blocks[i].covariance, fit.jitter_m).inverse();
      if (round > 0) {
        const Eigen::Vector2d gap = blocks[i].at - fit.Node(i);
        weight /= 1.0 + gap.dot(weight * gap) / 4.0;
      }
      information += rows.transpose() * weight * rows;
      right += rows.transpose() * weight * blocks[i].at;
    }
    fit.covariance = information.inverse();
    fit.rows = fit.covariance * right;
  }
}

double GapSigmas(const BlockPlace& block, const Fit& fit, std::size_t i) {
  const Eigen::Vector2d gap = block.at - fit.Node(i);
  return std::sqrt(gap.dot(WithJitter(block.covariance, fit.jitter_m).inverse() * gap));
}

/// -log likelihood of the gaps, each worth 3 sigmas at most.
double Misfit(std::span<const BlockPlace> blocks, const std::vector<bool>& used, const Fit& fit) {
  double misfit = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!used[i]) continue;
    const double gap = std::min(kMaxGap_sigmas, GapSigmas(blocks[i], fit, i));
    misfit += 0.5 * gap * gap +
              0.5 * std::log(WithJitter(blocks[i].covariance, fit.jitter_m).determinant());
  }
  return misfit;
}

/// The jitter that explains the gaps best, and the rows that go with it.
Fit BestJitter(std::span<const BlockPlace> blocks, const std::vector<bool>& used,
               const Fit& start) {
  Fit best = start;
  double least = 1e300;
  for (const double jitter_m : kJitters_m) {
    Fit fit = start;
    fit.jitter_m = jitter_m;
    SolveRows(blocks, used, fit);
    const double misfit = Misfit(blocks, used, fit);
    if (misfit >= least) continue;
    least = misfit;
    best = std::move(fit);
  }
  return best;
}

/// A block's own place and that in the rows, weighed.
LatticePlace Weighed(const BlockPlace& block, const Fit& fit, std::size_t i) {
  LatticePlace result{false, block, std::min(10.0, GapSigmas(block, fit, i))};
  if (result.gap_sigmas > kMaxGap_sigmas) return result;
  result.in_rows = true;
  const Rows rows = RowsOf(fit.cells[i]);
  const double jitter2 = fit.jitter_m * fit.jitter_m;
  const Eigen::Matrix2d own =
      jitter2 * WithJitter(block.covariance, fit.jitter_m).inverse();  // fraction of its own edges
  const Eigen::Matrix2d of_rows = Eigen::Matrix2d::Identity() - own;
  BlockPlace& place = result.place;
  place.at = fit.Node(i) + own * (block.at - fit.Node(i));
  place.covariance = own * block.covariance +
                     of_rows * rows * fit.covariance * rows.transpose() * of_rows.transpose();
  place.covariance = 0.5 * (place.covariance + place.covariance.transpose().eval());
  const double yaw_rad = std::atan2(fit.rows[3], fit.rows[2]);
  const double turn = std::remainder(block.yaw_rad - yaw_rad, 0.5 * std::numbers::pi);
  const double own_turn2 = block.yaw_sigma_rad * block.yaw_sigma_rad;
  const double row_turn2 = kTurnJitter_rad * kTurnJitter_rad;
  place.yaw_rad = block.yaw_rad - own_turn2 / (own_turn2 + row_turn2) * turn;
  place.yaw_sigma_rad = std::sqrt(own_turn2 * row_turn2 / (own_turn2 + row_turn2));
  return result;
}

}  // namespace

std::optional<BlockLattice> FindBlockLattice(std::span<const BlockPlace> blocks, double side_m) {
  std::vector<bool> used;
  int placed = 0;
  for (const BlockPlace& block : blocks) {
    used.push_back(WellPlaced(block));
    placed += used.back() ? 1 : 0;
  }
  if (placed < kMinBlocks) return std::nullopt;
  Fit fit;
  SearchCells(blocks, used, side_m, fit);
  fit = BestJitter(blocks, used, fit);
  if (fit.jitter_m >= kJitters_m.back()) return std::nullopt;
  BlockLattice lattice{fit.rows.tail<2>().norm(), fit.jitter_m, {}};
  int in_rows = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    lattice.places.push_back(Weighed(blocks[i], fit, i));
    in_rows += used[i] && lattice.places.back().in_rows ? 1 : 0;
  }
  if (in_rows < kMinBlocks || in_rows < kLeastFraction * placed) return std::nullopt;
  return lattice;
}

}  // namespace foresight
