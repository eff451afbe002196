#include "core/selfcheck/plate_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/quantile.h"
#include "core/base/tukey_weight.h"

namespace foresight {
namespace {

using Row = Eigen::Matrix<double, PlateCheck::kUnknowns, 1>;
using DriftMatrix = Eigen::Matrix<double, PlateCheck::kUnknowns, PlateCheck::kUnknowns>;

/// A cell's distance from its plane, and what it depends on.
struct Distance {
  std::size_t plane = 0;
  int part = 0;  ///< of its plane
  double value_m = 0.0;
  double sigma_m = 0.0;
  Row by_drift;
  Eigen::Vector4d by_plane;  ///< by two tilts, the offset and its ranges
};

Row ByDrift(const FlatCell& cell, const Eigen::Vector3d& normal, const Eigen::Vector3d& across,
            const Eigen::Vector2d& beam_rad) {
  const auto base_from_head = HeadFromBase(cell.plate_rad).Inverse();
  const Eigen::Vector3d n = base_from_head.Inverse().Rotate(normal);  // in head
  const Eigen::Vector3d by_turn = cell.in_head.cross(n);  // n . (turn x p) = turn . (p x n)
  Row row;
  row[PlateCheck::kTurnY] = by_turn.y();
  row[PlateCheck::kTurnZ] = by_turn.z();
  row[PlateCheck::kShiftY] = n.y();
  row[PlateCheck::kShiftZ] = n.z();
  row[PlateCheck::kRange] = n.dot(cell.direction);
  // A beam's half length on the surface, along the beam, is half its spread over the cosine n . d.
  const Eigen::Vector3d along = across.cross(cell.direction);
  row[PlateCheck::kNearEnd] = -0.5 * cell.in_head.norm() *
                              std::hypot(beam_rad.x() * n.dot(along), beam_rad.y() * n.dot(across));
  // A positive angle looks up: base_from_head = Rot_x(angle).
  row[PlateCheck::kStamp] =
      cell.speed_rad_s * normal.dot(Eigen::Vector3d::UnitX().cross(cell.center));
  return row;
}

constexpr int kStrips = 3, kParts = 2 * kStrips;

/// Numbers the parts of a plane: strips of as many cells each, and each strip across in two. Puts
/// the cells into their order.
void NumberParts(std::span<Distance> plane) {
  const auto split = [](std::span<Distance> some, int axis, int parts, const auto& use) {
    std::sort(some.begin(), some.end(), [axis](const Distance& a, const Distance& b) {
      return a.by_plane[axis] < b.by_plane[axis];
    });
    for (int i = 0; i < parts; ++i) {
      const std::size_t begin = some.size() * i / parts, end = some.size() * (i + 1) / parts;
      use(i, some.subspan(begin, end - begin));
    }
  };
  split(plane, 0, kStrips, [&](int strip, std::span<Distance> of_strip) {
    split(of_strip, 1, 2, [&](int half, std::span<Distance> of_part) {
      for (Distance& distance : of_part) distance.part = 2 * strip + half;
    });
  });
}

std::vector<Distance> DistancesOf(const std::vector<FlatCell>& cells,
                                  const std::vector<CoplanarCells>& planes,
                                  const Eigen::Vector3d& across, const PlateCheckOptions& options) {
  std::vector<Distance> distances;
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const CoplanarCells& plane = planes[p];
    const Eigen::Vector3d first = plane.normal.unitOrthogonal();
    const Eigen::Vector3d second = plane.normal.cross(first);
    const std::size_t begin = distances.size();
    for (const std::size_t i : plane.cells) {
      const FlatCell& cell = cells[i];
      const Eigen::Vector3d off = cell.center - plane.center;
      const Row by_drift = ByDrift(cell, plane.normal, across, options.beam_rad);
      distances.push_back(
          {p, 0, plane.normal.dot(off),
           std::hypot(cell.rms_m / std::sqrt(cell.points), options.floor_m), by_drift,
           Eigen::Vector4d(off.dot(first), off.dot(second), 1.0, by_drift[PlateCheck::kRange])});
    }
    NumberParts(std::span(distances).subspan(begin));
  }
  return distances;
}

/// Weighted least squares of all planes and the drift, with Huber's weights.
class PlaneAdjustment {
 public:
  PlaneAdjustment(const std::vector<Distance>& distances, std::size_t planes, bool up_and_down,
                  const PlateCheckOptions& options)
      : distances_(distances), options_(options), up_and_down_(up_and_down) {
    unknowns_ = PlateCheck::kUnknowns + 4 * static_cast<Eigen::Index>(planes);
  }

  void Solve() {
    answer_ = Eigen::VectorXd::Zero(unknowns_);
    for (int round = 0; round < kRounds; ++round) {
      huber_ = round < kHuberRounds;
      UpdateScale();
      equations_ = {PriorMatrix(), Eigen::VectorXd::Zero(unknowns_)};
      for (const Distance& d : distances_) equations_ += Weighted(d);
      inverse_ = equations_.matrix.inverse();
      answer_ = inverse_ * equations_.right;
    }
    UpdateScale();
  }

  Row drift() const { return answer_.head<PlateCheck::kUnknowns>(); }
  /// What the cells' scatter says, and what answers without one part of a plane each do: where a
  /// plane is none (stones side by side, a bent wall) its cells are not off at random.
  DriftMatrix Covariance() const {
    DriftMatrix covariance =
        scale_ * scale_ * inverse_.topLeftCorner<PlateCheck::kUnknowns, PlateCheck::kUnknowns>();
    std::vector<Equations> parts;
    for (const Distance& d : distances_) {
      const std::size_t part = kParts * d.plane + d.part;
      while (parts.size() <= part)
        parts.push_back(
            {Eigen::MatrixXd::Zero(unknowns_, unknowns_), Eigen::VectorXd::Zero(unknowns_)});
      parts[part] += Weighted(d);
    }
    for (const Equations& part : parts) {
      const Eigen::VectorXd without =
          (equations_.matrix - part.matrix).ldlt().solve(equations_.right - part.right);
      const Row change = (without - answer_).head<PlateCheck::kUnknowns>();
      covariance += (kParts - 1.0) / kParts * change * change.transpose();
    }
    return covariance;
  }
  double Rms() const {
    double squares = 0.0;
    for (const Distance& d : distances_) squares += std::pow(Residual(d), 2);
    return std::sqrt(squares / static_cast<double>(distances_.size()));
  }

 private:
  struct Equations {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;

    void operator+=(const Equations& other) {
      matrix += other.matrix;
      right += other.right;
    }
  };

  Equations Weighted(const Distance& d) const {
    const Eigen::VectorXd row = RowOf(d);
    const double weight = WeightOf(d);
    return {weight * row * row.transpose(), -weight * d.value_m * row};
  }
  Eigen::VectorXd RowOf(const Distance& d) const {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns_);
    row.head<PlateCheck::kUnknowns>() = d.by_drift;
    if (!up_and_down_) row[PlateCheck::kStamp] = 0.0;
    row.segment<4>(PlateCheck::kUnknowns + 4 * static_cast<Eigen::Index>(d.plane)) = d.by_plane;
    return row;
  }
  double Residual(const Distance& d) const { return d.value_m + RowOf(d).dot(answer_); }
  /// Huber's at first, then Tukey's: things that stand a little before a wall do not count.
  double WeightOf(const Distance& d) const {
    const double off = std::abs(Residual(d)) / (scale_ * d.sigma_m);
    const double full = 1.0 / (d.sigma_m * d.sigma_m);
    if (huber_) return full * std::min(1.0, options_.huber_sigmas / off);
    return full * TukeyWeight(off / options_.tukey_sigmas);
  }
  /// How much more the cells scatter than their sigmas say: bent walls, unevenness.
  void UpdateScale() {
    std::vector<double> offs;
    for (const Distance& d : distances_) offs.push_back(std::abs(Residual(d)) / d.sigma_m);
    constexpr double kMadToSigma = 1.4826;
    scale_ = std::max(1.0, kMadToSigma * UpperMedian(std::move(offs)));
  }
  Eigen::MatrixXd PriorMatrix() const {
    // Weak ones keep the matrix regular where a scan does not say an unknown.
    constexpr double kAnyTurn_rad = 0.2, kAnyStamp_s = 0.5, kAnyPlane = 1.0;
    Eigen::VectorXd sigmas = Eigen::VectorXd::Constant(unknowns_, kAnyPlane);
    sigmas[PlateCheck::kTurnY] = sigmas[PlateCheck::kTurnZ] = kAnyTurn_rad;
    sigmas[PlateCheck::kShiftY] = sigmas[PlateCheck::kShiftZ] = options_.shift_prior_m;
    sigmas[PlateCheck::kRange] = options_.range_prior_m;
    sigmas[PlateCheck::kNearEnd] = options_.near_end_prior;
    for (Eigen::Index i = PlateCheck::kUnknowns + 3; i < unknowns_; i += 4)
      sigmas[i] = options_.color_prior_m;
    sigmas[PlateCheck::kStamp] = kAnyStamp_s;
    return sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  }

  static constexpr int kRounds = 15, kHuberRounds = 5;

  const std::vector<Distance>& distances_;
  const PlateCheckOptions& options_;
  bool up_and_down_;
  bool huber_ = true;
  Eigen::Index unknowns_;
  Eigen::VectorXd answer_;
  Equations equations_;
  Eigen::MatrixXd inverse_;
  double scale_ = 1.0;
};

/// Both directions are seen where the lesser one has a tenth of the cells.
bool UpAndDown(const std::vector<FlatCell>& cells, const std::vector<CoplanarCells>& planes) {
  std::size_t up = 0, all = 0;
  for (const CoplanarCells& plane : planes)
    for (const std::size_t i : plane.cells) {
      up += cells[i].speed_rad_s > 0.0 ? 1 : 0;
      ++all;
    }
  return 10 * std::min(up, all - up) > all;
}

}  // namespace

Result<PlateCheck> CheckPlate(const Scan& scan, const RegisteredScan& cloud,
                              const PlateCheckOptions& options) {
  const std::vector<FlatCell> cells = FindFlatCells(scan, cloud, options.cells);
  const std::vector<CoplanarCells> planes = FindCoplanarCells(cells, options.planes);
  if (static_cast<int>(planes.size()) < options.least_planes)
    return Fail(ErrorCode::kTooFewPoints,
                "{} planes in the scan, {} are needed: scan where walls, floor or ceiling are in "
                "view",
                planes.size(), options.least_planes);
  const std::vector<Distance> distances = DistancesOf(
      cells, planes, scan.rig.HeadFromLidar().Rotate(Eigen::Vector3d::UnitZ()), options);
  PlateCheck check;
  check.up_and_down = UpAndDown(cells, planes);
  PlaneAdjustment adjustment(distances, planes.size(), check.up_and_down, options);
  adjustment.Solve();
  check.drift = adjustment.drift();
  check.covariance = adjustment.Covariance();
  if (!check.up_and_down) {
    check.drift[PlateCheck::kStamp] = 0.0;
    check.covariance(PlateCheck::kStamp, PlateCheck::kStamp) =
        std::numeric_limits<double>::infinity();
  }
  double squares = 0.0;
  for (const FlatCell& cell : cells) squares += cell.speed_rad_s * cell.speed_rad_s;
  check.speed_rad_s = std::sqrt(squares / static_cast<double>(cells.size()));
  check.planes = static_cast<int>(planes.size());
  check.cells = static_cast<int>(distances.size());
  check.residual_m = adjustment.Rms();
  return check;
}

}  // namespace foresight
