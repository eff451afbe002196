#include "core/calibration/chain_costs.h"

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"

namespace foresight::chain {
namespace {

/// A parameter block: numbers, or a pose that is moved by a step in its own frame.
struct Parameters {
  std::vector<double> values;
  bool pose = false;

  Eigen::Index StepSize() const { return pose ? 6 : static_cast<Eigen::Index>(values.size()); }
  Parameters Moved(Eigen::Index dimension, double step) const {
    Parameters moved = *this;
    if (!pose) {
      moved.values[static_cast<std::size_t>(dimension)] += step;
      return moved;
    }
    const Eigen::Matrix<double, 6, 1> by = step * Eigen::Matrix<double, 6, 1>::Unit(dimension);
    const PoseBlock block =
        BlockOf(Perturbed(PoseOf<frame::Camera, frame::Head>(values.data()), by));
    moved.values.assign(block.begin(), block.end());
    return moved;
  }
};

template <class To, class From>
Parameters Pose(const Rigid<To, From>& rigid) {
  const PoseBlock block = BlockOf(rigid);
  return {{block.begin(), block.end()}, true};
}

template <class To, class From>
Rigid<To, From> RandomlyMoved(const Rigid<To, From>& rigid, Random& random) {
  Eigen::Matrix<double, 6, 1> step;
  for (Eigen::Index i = 0; i < 6; ++i) step[i] = random.Uniform(-0.1, 0.1);
  return Perturbed(rigid, step);
}

std::vector<const double*> Pointers(const std::vector<Parameters>& blocks) {
  std::vector<const double*> pointers;
  for (const Parameters& block : blocks) pointers.push_back(block.values.data());
  return pointers;
}

Eigen::VectorXd Residuals(const ceres::CostFunction& cost, const std::vector<Parameters>& blocks) {
  Eigen::VectorXd residuals(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(Pointers(blocks).data(), residuals.data(), nullptr));
  return residuals;
}

/// Every derivative against central differences.
void ExpectDerivatives(const ceres::CostFunction& cost, const std::vector<Parameters>& blocks) {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  ASSERT_EQ(cost.parameter_block_sizes().size(), blocks.size());
  std::vector<Jacobian> jacobians;
  std::vector<double*> pointers;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    ASSERT_EQ(cost.parameter_block_sizes()[b], static_cast<int>(blocks[b].values.size()));
    jacobians.emplace_back(Jacobian::Zero(cost.num_residuals(), cost.parameter_block_sizes()[b]));
  }
  for (Jacobian& jacobian : jacobians) pointers.push_back(jacobian.data());
  Eigen::VectorXd residuals(cost.num_residuals());
  ASSERT_TRUE(cost.Evaluate(Pointers(blocks).data(), residuals.data(), pointers.data()));
  ASSERT_GT(residuals.norm(), 0.1) << "a residual of 0 hides what scales with it";
  // Central differences of 1e-6: the cut-off error is 1e-12 of the third derivative, rounding
  // 2e-16 / 1e-6 of coordinates that the residuals are some tens of times larger than.
  constexpr double kStep = 1e-6, kRounding = 1e-8;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (Eigen::Index i = 0; i < blocks[b].StepSize(); ++i) {
      auto up = blocks, down = blocks;
      up[b] = blocks[b].Moved(i, kStep);
      down[b] = blocks[b].Moved(i, -kStep);
      const Eigen::VectorXd numeric = (Residuals(cost, up) - Residuals(cost, down)) / (2.0 * kStep);
      const Eigen::VectorXd ours = jacobians[b].col(i);
      EXPECT_LT((ours - numeric).norm(), 1e-6 * numeric.norm() + kRounding * residuals.norm())
          << "block " << b << ", step " << i << ": " << ours.head(2).transpose() << " against "
          << numeric.head(2).transpose();
    }
}

/// A head before a stand, with every pose off its simplest place.
class ChainCosts : public testing::Test {
 protected:
  ChainCosts() : random_(3) {
    const SensorRig rig = DefaultSensorRig();
    camera_ = rig.camera;
    head_ = RandomlyMoved(rig.camera_from_head, random_);
    lidar_ = RandomlyMoved(rig.camera_from_lidar, random_);
    mount_ = RandomlyMoved(DefaultBoardMount().a_from_b, random_);
    base_from_pattern_ = RandomlyMoved(
        Rigid<frame::Base, frame::Pattern>(Eigen::Quaterniond::Identity(), {-0.2, -0.1, 1.2}),
        random_);
  }

  CornerSet Corners(bool on_b) {
    CornerSet corners;
    corners.stop = 1;
    corners.on_b = on_b;
    for (int id = 0; id < 6; ++id) {
      corners.on_board.push_back(DefaultBoardMount().a.Corner(7 * id));
      corners.pixels.emplace_back(random_.Uniform(300.0, 900.0), random_.Uniform(300.0, 700.0));
    }
    return corners;
  }

  BoardHits Hits(bool on_b, int stop) {
    BoardHits hits;
    hits.stop = stop;
    hits.on_b = on_b;
    for (int beam = 500; beam < 560; beam += 10)
      hits.returns.push_back({LidarModel().BeamDirection(beam), random_.Uniform(1.0, 1.4), 0.02,
                              0.5 + 0.001 * beam, beam});
    return hits;
  }

  /// Steady, so that the track's straight lines are exact and its angle has a derivative.
  static MotorTrack SteadyTrack() {
    MotorTrack track;
    for (int i = 0; i < 600; ++i) track.Add({i / 240.0, 0.9 * i / 240.0 - 0.8});
    return track;
  }

  Parameters Camera() const {
    const auto values = camera_.Values();
    return {{values.data(), values.data() + values.size()}};
  }
  Parameters Angles() const { return {{-0.48, 0.01, 0.50}}; }

  std::vector<Parameters> MountBlocks(bool on_b) const {
    std::vector<Parameters> blocks = {
        Camera(), Pose(head_), Angles(), {{0.003}}, Pose(base_from_pattern_)};
    if (on_b) blocks.push_back(Pose(mount_));
    return blocks;
  }
  std::vector<Parameters> HitBlocks(bool on_b, double own) const {
    std::vector<Parameters> blocks = {Pose(lidar_), {{0.01}}, Pose(head_),
                                      Angles(),     {{own}},  Pose(base_from_pattern_)};
    if (on_b) blocks.push_back(Pose(mount_));
    return blocks;
  }

  Random random_;
  CameraModel camera_;
  Rigid<frame::Camera, frame::Head> head_;
  Rigid<frame::Camera, frame::Lidar> lidar_;
  BoardFromBoard mount_;
  Rigid<frame::Base, frame::Pattern> base_from_pattern_;
  std::shared_ptr<const AngleTable> angles_ =
      std::make_shared<AngleTable>(std::vector<double>{-0.5, 0.0, 0.5});
};

TEST_F(ChainCosts, ViewHasTheDerivativesOfDifferences) {
  const auto pose = Rigid<frame::Camera, frame::Pattern>(base_from_pattern_.rotation(),
                                                         base_from_pattern_.translation());
  ExpectDerivatives(*MakeViewCost(Corners(false), camera_, 0.3), {Camera(), Pose(pose)});
}

TEST_F(ChainCosts, StandHasTheDerivativesOfDifferences) {
  for (const bool on_b : {false, true}) {
    SCOPED_TRACE(on_b);
    ExpectDerivatives(*MakeMountCost(Corners(on_b), camera_, 3, 0.3), MountBlocks(on_b));
  }
}

TEST_F(ChainCosts, ReturnsHaveTheDerivativesOfDifferences) {
  const MotorTrack track = SteadyTrack();
  for (const LidarResidual residual : {LidarResidual::kRange, LidarResidual::kPerpendicular})
    for (const double huber : {0.0, 1.5})
      for (const bool on_b : {false, true})
        for (const int stop : {1, BoardHits::kNone}) {
          SCOPED_TRACE(testing::Message() << "residual " << static_cast<int>(residual) << ", Huber "
                                          << huber << ", board B " << on_b << ", stop " << stop);
          const BoardHits hits = Hits(on_b, stop);
          ExpectDerivatives(*MakeHitCost(hits, angles_, &track, {residual, huber}),
                            HitBlocks(on_b, 0.002));
        }
}

TEST_F(ChainCosts, PriorHasTheDerivativeOfDifferences) {
  ExpectDerivatives(*MakePriorCost(0.02), {{{0.05}}});
}

}  // namespace
}  // namespace foresight::chain
