#include "core/fitting/terrain/block_lattice.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kSide_m = 0.3935;
constexpr double kPitch_m = 0.42;

/// What edges say of blocks, and where the blocks are.
struct Field {
  std::vector<BlockPlace> measured;
  std::vector<Eigen::Vector2d> truth;
};

/// 3 x 4 blocks in rows turned by 17 deg, each up to 6 mm off them; edges are wrong by `along_m`
/// in y and 3 mm in x.
Field InRows(double along_m, std::uint64_t seed) {
  Random random(seed);
  const double yaw = RadiansFromDegrees(17.0);
  Field field;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 3; ++column) {
      const Eigen::Vector2d jitter(random.Uniform(-0.006, 0.006), random.Uniform(-0.006, 0.006));
      field.truth.push_back(Eigen::Vector2d(0.3, 1.1) +
                            Eigen::Rotation2Dd(yaw) * Eigen::Vector2d(column, row) * kPitch_m +
                            jitter);
      BlockPlace place;
      place.covariance = Eigen::Vector2d(9e-6, along_m * along_m).asDiagonal();
      place.at =
          field.truth.back() + Eigen::Vector2d(0.003 * random.Normal(), along_m * random.Normal());
      place.yaw_sigma_rad = RadiansFromDegrees(1.5);
      place.yaw_rad =
          yaw + place.yaw_sigma_rad * random.Normal() + RadiansFromDegrees(90.0) * random.Index(4);
      field.measured.push_back(place);
    }
  return field;
}

double MeanSquare(const Field& field, const std::vector<LatticePlace>* settled) {
  double sum = 0.0;
  for (std::size_t i = 0; i < field.truth.size(); ++i) {
    const BlockPlace& place = settled != nullptr ? (*settled)[i].place : field.measured[i];
    sum += (place.at - field.truth[i]).squaredNorm();
  }
  return sum / static_cast<double>(field.truth.size());
}

TEST(BlockLattice, NeighborsPlaceABlockWhoseEdgesSayLittle) {
  double alone = 0.0, together = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Field field = InRows(0.014, seed);
    const auto lattice = FindBlockLattice(field.measured, kSide_m);
    ASSERT_TRUE(lattice) << "seed " << seed;
    EXPECT_NEAR(lattice->pitch_m, kPitch_m, 0.010) << "seed " << seed;
    alone += MeanSquare(field, nullptr);
    together += MeanSquare(field, &lattice->places);
  }
  // 14 mm of its own against 4 to 8 mm of the rows: at best a third of the square is left.
  EXPECT_LT(together, 0.5 * alone);
}

TEST(BlockLattice, SaysHowWellItPlacesThem) {
  double gaps = 0.0;
  int blocks = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Field field = InRows(0.014, seed);
    const auto lattice = FindBlockLattice(field.measured, kSide_m);
    ASSERT_TRUE(lattice) << "seed " << seed;
    for (std::size_t i = 0; i < field.truth.size(); ++i) {
      const BlockPlace& place = lattice->places[i].place;
      const Eigen::Vector2d gap = place.at - field.truth[i];
      gaps += gap.dot(place.covariance.inverse() * gap);
      ++blocks;
    }
  }
  // Squared gaps in deviations: 2 on average. How far blocks lie off their rows is an estimate.
  EXPECT_NEAR(gaps / blocks, 2.0, 0.8);
}

TEST(BlockLattice, LeavesABlockAloneThatStandsOffTheRows) {
  Field field = InRows(0.005, 3);
  field.measured[4].at += Eigen::Vector2d(0.12, -0.09);
  const auto lattice = FindBlockLattice(field.measured, kSide_m);
  ASSERT_TRUE(lattice);
  EXPECT_FALSE(lattice->places[4].in_rows);
  EXPECT_EQ(lattice->places[4].place.at, field.measured[4].at);
  EXPECT_TRUE(lattice->places[5].in_rows);
}

TEST(BlockLattice, ScatteredBlocksMakeNoRows) {
  Random random(5);
  int found = 0;
  for (int field = 0; field < 100; ++field) {
    std::vector<BlockPlace> blocks(6);
    for (BlockPlace& block : blocks) {
      block.at = {random.Uniform(-1.0, 1.0), random.Uniform(0.8, 2.5)};
      block.covariance = 1e-4 * Eigen::Matrix2d::Identity();
      block.yaw_rad = random.Uniform(-3.0, 3.0);
      block.yaw_sigma_rad = 0.03;
    }
    found += FindBlockLattice(blocks, kSide_m) ? 1 : 0;
  }
  EXPECT_LE(found, 2);
}

TEST(BlockLattice, FourBlocksAreTooFewToTell) {
  Field field = InRows(0.005, 1);
  field.measured.resize(4);
  EXPECT_FALSE(FindBlockLattice(field.measured, kSide_m));
}

}  // namespace
}  // namespace foresight
