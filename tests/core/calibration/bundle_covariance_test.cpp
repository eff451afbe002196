#include "core/calibration/bundle_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "tests/core/calibration/synthetic_views.h"

namespace foresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The adjusted bundle of a seed; all seeds see the same boards with other noise.
CameraBundle Adjusted(const CameraBundle& truth, double noise_px, std::uint64_t seed,
                      bool free_warp) {
  Random random(seed);
  CameraBundle bundle = truth;
  for (std::size_t view = 0; view < bundle.views.size(); ++view) {
    BoardView& seen = bundle.views[view];
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
      seen.pixels[i] = *truth.camera.Project(truth.poses[view] *
                                             truth.board.Corner(seen.corner_ids[i], truth.warp)) +
                       noise_px * Eigen::Vector2d(random.Normal(), random.Normal());
  }
  EXPECT_TRUE(AdjustBundle(bundle, {.free_warp = free_warp}, RunContext()));
  return bundle;
}

/// Where the point that `pixel` sees in the true camera appears in a bundle: known by where it lies
/// to the boards.
Eigen::Vector2d PixelIn(const CameraBundle& truth, const CameraBundle& bundle,
                        const Eigen::Vector2d& pixel, double distance_m) {
  const Eigen::Vector3d ray = *truth.camera.Unproject(pixel);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t view = 0; view < truth.poses.size(); ++view)
    sum += std::isinf(distance_m)
               ? bundle.poses[view].Rotate(truth.poses[view].Inverse().Rotate(ray))
               : bundle.poses[view] * (truth.poses[view].Inverse() * (distance_m * ray));
  return *bundle.camera.Project(sum / static_cast<double>(truth.poses.size()));
}

struct Spread {
  Eigen::VectorXd values;             ///< variance of each value
  std::vector<double> predicted_px2;  ///< trace, a probe
  std::vector<double> empirical_px2;
  Eigen::VectorXd predicted;
};

const std::vector<std::pair<Eigen::Vector2d, double>> kProbes = {{{644.0, 482.0}, 1.0},
                                                                 {{644.0, 482.0}, kInfinity},
                                                                 {{60.0, 60.0}, 1.0},
                                                                 {{60.0, 60.0}, kInfinity},
                                                                 {{1200.0, 500.0}, 4.0}};

Spread SpreadOver(int seeds, bool free_warp) {
  SyntheticOptions options{.views = 20};
  const CameraBundle truth = MakeViews(options, 31).truth;
  Spread spread;
  CameraModel::Parameters values = truth.camera.Values();
  spread.values = Eigen::VectorXd::Zero(values.size());
  spread.predicted = Eigen::VectorXd::Zero(values.size());
  spread.empirical_px2.resize(kProbes.size());
  spread.predicted_px2.resize(kProbes.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const CameraBundle bundle =
        Adjusted(truth, options.noise_px, 1000 + static_cast<std::uint64_t>(seed), free_warp);
    const auto covariance = BundleCovariance::Of(bundle, free_warp);
    EXPECT_TRUE(covariance);
    spread.values += (bundle.camera.Values() - values).cwiseAbs2() / seeds;
    spread.predicted += covariance->ValueSigmas().cwiseAbs2() / seeds;
    for (std::size_t i = 0; i < kProbes.size(); ++i) {
      const auto& [pixel, distance_m] = kProbes[i];
      spread.empirical_px2[i] +=
          (PixelIn(truth, bundle, pixel, distance_m) - pixel).squaredNorm() / seeds;
      spread.predicted_px2[i] += covariance->OfProjection(pixel, distance_m)->trace() / seeds;
    }
  }
  return spread;
}

/// @param slack of a standard deviation's ratio to the predicted one, both ways.
void ExpectHonest(const Spread& spread, double slack) {
  for (Eigen::Index i = 0; i < spread.values.size(); ++i) {
    const double ratio = std::sqrt(spread.values[i] / spread.predicted[i]);
    EXPECT_GT(ratio, 1.0 - slack) << "value " << i;
    EXPECT_LT(ratio, 1.0 + slack) << "value " << i;
  }
  for (std::size_t i = 0; i < kProbes.size(); ++i) {
    const double ratio = std::sqrt(spread.empirical_px2[i] / spread.predicted_px2[i]);
    EXPECT_GT(ratio, 1.0 - slack) << "probe " << i << ": " << std::sqrt(spread.predicted_px2[i]);
    EXPECT_LT(ratio, 1.0 + slack) << "probe " << i << ": " << std::sqrt(spread.predicted_px2[i]);
  }
}

TEST(BundleCovariance, PredictsTheSpreadOfManySolves) {
  // The bar is 0.7 to 1.4. A standard deviation from 30 draws is itself 13 % uncertain, so
  // 40 % is three of those.
  ExpectHonest(SpreadOver(30, false), 0.4);
}

TEST(BundleCovarianceByNight, PredictsTheSpreadOfManySolvesWithWarp) {
  // From 200 draws: 5 %, three of those and a little for what is not linear.
  ExpectHonest(SpreadOver(200, true), 0.17);
}

TEST(BundleCovariance, FindsTheNoise) {
  const CameraBundle truth = MakeViews({.views = 20}, 32).truth;
  const CameraBundle bundle = Adjusted(truth, 0.287, 5, false);
  // 1920 coordinates: the standard deviation is known to 1.7 %; three of those.
  EXPECT_NEAR(BundleCovariance::Of(bundle, false)->noise_px(), 0.287, 0.05 * 0.287);
}

TEST(BundleCovariance, IsLargerWhereNoBoardWas) {
  SyntheticOptions options{.views = 20};
  CameraBundle truth = MakeViews(options, 33).truth;
  // Only views in the middle of the image.
  for (std::size_t view = truth.views.size(); view-- > 0;) {
    bool outside = false;
    for (const Eigen::Vector2d& pixel : truth.views[view].pixels)
      outside |= (pixel - Eigen::Vector2d(644.0, 482.0)).norm() > 420.0;
    if (!outside) continue;
    truth.views.erase(truth.views.begin() + static_cast<std::ptrdiff_t>(view));
    truth.poses.erase(truth.poses.begin() + static_cast<std::ptrdiff_t>(view));
  }
  ASSERT_GE(truth.views.size(), 3u);
  const CameraBundle bundle = Adjusted(truth, 0.287, 6, false);
  const auto covariance = BundleCovariance::Of(bundle, false);
  ASSERT_TRUE(covariance);
  EXPECT_GT(covariance->OfProjection({20.0, 20.0}, kInfinity)->trace(),
            4.0 * covariance->OfProjection({644.0, 482.0}, kInfinity)->trace());
}

TEST(AdjustBundle, ReachesTheLeastSquaresSolutionFromAfar) {
  const CameraBundle truth = MakeViews({.views = 15}, 34).truth;
  const CameraBundle near = Adjusted(truth, 0.287, 7, true);
  CameraBundle far = near;
  CameraModel::Parameters values = far.camera.Values();
  values *= 1.03;
  far.camera = far.camera.WithValues(values);
  ASSERT_TRUE(AdjustBundle(far, {.free_warp = true}, RunContext()));
  EXPECT_NEAR(SummarizeErrors(far).rms_px, SummarizeErrors(near).rms_px, 1e-6);
  EXPECT_LT((far.camera.Values() - near.camera.Values()).cwiseAbs().maxCoeff(), 1e-2);
}

}  // namespace
}  // namespace foresight
