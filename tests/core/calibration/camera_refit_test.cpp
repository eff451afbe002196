#include "core/calibration/camera_refit.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

CameraModel WideCamera(const Lens& lens) {
  return {.width = 1288,
          .height = 964,
          .fx = 601.36,
          .fy = 600.80,
          .cx = 650.3,
          .cy = 477.1,
          .lens = lens};
}

TEST(CameraRefit, SaysAKLensInFourCoefficientsToAHundredthOfAPixel) {
  const CameraModel camera = WideCamera(FisheyeLens{0.9413});
  const auto refit = RefitCamera(camera, LensModel::kKannalaBrandt, PixelGrid(camera));
  ASSERT_TRUE(refit) << refit.error().message;
  EXPECT_EQ(refit->not_shown, 0);
  EXPECT_LT(refit->max_error_px, 0.01);
  // Measured on the same rays: the stated error is the real one.
  double largest = 0.0;
  for (const Eigen::Vector2d& pixel : PixelGrid(camera))
    largest = std::max(largest, (*refit->camera.Project(*camera.Unproject(pixel)) - pixel).norm());
  EXPECT_DOUBLE_EQ(refit->max_error_px, largest);
}

TEST(CameraRefit, ComesBackToTheSameCamera) {
  for (const Lens& lens :
       {Lens(FisheyeLens{0.9413}), Lens(KannalaBrandtLens(-0.02, 0.01, 0.0, 0.0)),
        Lens(ExtendedUnifiedLens{0.6, 1.1}),
        Lens(RadialTangentialLens(-0.1, 0.02, 1e-3, -5e-4, 0.0))}) {
    CameraModel camera = WideCamera(lens);
    if (std::holds_alternative<RadialTangentialLens>(lens)) camera.fx = camera.fy = 1100.0;
    const auto refit = RefitCamera(camera, LensModelOf(lens), PixelGrid(camera));
    ASSERT_TRUE(refit) << camera.Key() << ": " << refit.error().message;
    EXPECT_LT(refit->max_error_px, 1e-4) << camera.Key();
  }
}

TEST(CameraRefit, StatesHowBadAPinholeIs) {
  const CameraModel camera = WideCamera(FisheyeLens{0.9413});
  const auto refit = RefitCamera(camera, LensModel::kRadialTangential, PixelGrid(camera));
  EXPECT_TRUE(!refit || refit->max_error_px > 0.5);
}

}  // namespace
}  // namespace foresight
