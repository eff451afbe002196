#include "core/calibration/projection_maps.h"

#include <gtest/gtest.h>

#include "tests/core/calibration/synthetic_views.h"

namespace foresight {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();
constexpr MapSize kSize = {16, 12};

CameraBundle AdjustedViews(double noise_px, int views = 20) {
  const SyntheticViews made = MakeViews({.views = views, .noise_px = noise_px}, 5);
  CameraBundle bundle = made.truth;
  for (std::size_t view = 0; view < bundle.views.size(); ++view)
    bundle.views[view] = made.images[view].view;
  EXPECT_TRUE(AdjustBundle(bundle, {}, RunContext()));
  return bundle;
}

TEST(ProjectionMaps, ACameraIsKnownBestWhereItsBoardsWere) {
  const CameraBundle bundle = AdjustedViews(0.287);
  const auto covariance = BundleCovariance::Of(bundle, false);
  ASSERT_TRUE(covariance);
  const CameraModel& camera = bundle.camera;
  const ImageField near =
      ProjectionUncertainty(*covariance, camera.width, camera.height, 0.9, kSize);
  ASSERT_EQ(near.values.size(), 16u * 12u);
  // The middle has boards all round, the corner on one side.
  EXPECT_LT(2.0 * near.At(8, 6), near.At(0, 0));
  EXPECT_EQ(near.Largest(), *std::max_element(near.values.begin(), near.values.end()));
  const ImageField far =
      ProjectionUncertainty(*covariance, camera.width, camera.height, kFarAway, kSize);
  // Boards were 0.5 to 1.2 m away; at infinity the poses' errors count in full.
  EXPECT_GT(far.Median(), near.Median());
}

TEST(ProjectionMaps, AFieldsCellsAreSpreadOverTheImageFromItsFirstPixelsEdge) {
  const ImageField field{100, 50, 10, 5, {}};
  EXPECT_EQ(field.Middle(0, 0), Eigen::Vector2d(4.5, 4.5));
  EXPECT_EQ(field.Middle(9, 4), Eigen::Vector2d(94.5, 44.5));
}

TEST(ProjectionMaps, HalvesOfExactImagesAreOneCamera) {
  const auto halves = CalibrateHalves(AdjustedViews(0.0), false, RunContext());
  ASSERT_TRUE(halves) << halves.error().message;
  // What the solver stops at.
  EXPECT_LT(DifferenceOfHalves(*halves, 1.0, kSize).Largest(), 1e-4);
  EXPECT_LT(DifferenceOfHalves(*halves, kFarAway, kSize).Largest(), 1e-4);
}

TEST(ProjectionMaps, HalvesOfNoisyImagesDifferAsTheUncertaintySays) {
  const CameraBundle bundle = AdjustedViews(0.287, 24);
  const auto halves = CalibrateHalves(bundle, false, RunContext());
  ASSERT_TRUE(halves) << halves.error().message;
  const double difference = DifferenceOfHalves(*halves, kFarAway, kSize).Median();
  const double sigma =
      ProjectionUncertainty(*BundleCovariance::Of(bundle, false), bundle.camera.width,
                            bundle.camera.height, kFarAway, kSize)
          .Median();
  // Each half has half of the images, so that two halves differ by 2 sigma; one draw of it.
  EXPECT_GT(difference, 0.4 * sigma);
  EXPECT_LT(difference, 5.0 * sigma);
}

TEST(ProjectionMaps, ATurnOfTheWholeCameraIsNoDifference) {
  CameraHalves halves;
  halves.odd = halves.even = SyntheticOptions().camera;
  halves.even.cx += 6.0;
  for (const BoardView& view : AdjustedViews(0.0).views)
    halves.pixels.insert(halves.pixels.end(), view.pixels.begin(), view.pixels.end());
  // The k lens is nearly equidistant: most of a shift of the principal point is a turn.
  EXPECT_LT(DifferenceOfHalves(halves, kFarAway, kSize).Median(), 2.0);
}

TEST(ProjectionMaps, ThreeImagesHaveNoHalves) {
  const auto halves = CalibrateHalves(AdjustedViews(0.287, 3), false, RunContext());
  ASSERT_FALSE(halves);
  EXPECT_EQ(halves.error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace foresight
