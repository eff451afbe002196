// Real data: 15 images of a board and 15 scans of a nodding laser, Unnikrishnan and Hebert,
// CMU-RI-TR-05-09. FORESIGHT_TEST_DATA/calibration/lcct.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/calibration/board_images.h"
#include "core/calibration/board_pose.h"
#include "core/calibration/calibrate_lidar.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

const std::filesystem::path kFolder =
    std::filesystem::path(FORESIGHT_TEST_DATA) / "calibration" / "lcct";

/// As published with the data.
CameraModel PublishedCamera() {
  return {.width = 640,
          .height = 480,
          .fx = 1588.85,
          .fy = 1589.14,
          .cx = 336.85,
          .cy = 166.22,
          .lens = RadialTangentialLens(-0.1834, -0.0344, -0.0055, 0.0044, 0.0)};
}

Rigid<frame::Camera, frame::Lidar> PublishedLidar() {
  Eigen::Matrix3d rotation;
  rotation << -0.523899, 0.851678, -0.013232,  //
      0.117787, 0.057052, -0.991399,           //
      -0.843597, -0.520951, -0.130206;
  return {rotation, Eigen::Vector3d(-0.194578, 0.032626, -0.093925)};
}

/// Points in the order of the scan, a profile where the mirror turns back.
std::vector<LidarProfile> ProfilesOf(const std::filesystem::path& file, int pose) {
  constexpr double kStep_rad = 0.00077493, kTurnsBack_rad = 0.01, kSigma_m = 0.004;
  std::ifstream stream(file);
  std::vector<LidarProfile> profiles;
  double last_azimuth = -10.0;
  for (Eigen::Vector3d p; stream >> p.x() >> p.y() >> p.z();) {
    const double range = p.norm();
    if (!(range > 0.1)) continue;
    const double azimuth = std::atan2(p.y(), p.x());
    if (profiles.empty() || azimuth > last_azimuth + kTurnsBack_rad)
      profiles.push_back({pose, pose, 0, {}});
    last_azimuth = azimuth;
    profiles.back().returns.push_back(
        {p / range, range, kSigma_m, 0.0, static_cast<int>(std::lround(-azimuth / kStep_rad))});
  }
  return profiles;
}

class Lcct : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "needs FORESIGHT_TEST_DATA: " << kFolder;
    mount_.a = *CalibrationBoardFromText("checkerboard:7x5:30");
    state_.camera = PublishedCamera();
    state_.motor_rad = {0.0};
    state_.plate_rad = {0.0};
    const auto files = ListImageFiles({kFolder.string()});
    ASSERT_TRUE(files) << files.error().message;
    const auto images = DetectBoards(*files, mount_.a, {});
    ASSERT_TRUE(images) << images.error().message;
    for (const IntrinsicsImage& image : images->images) {
      const auto pose = FindBoardPose(mount_.a, image.view, state_.camera);
      ASSERT_TRUE(pose) << image.name;
      // No motor: the camera is the base, a board's place one pose each.
      const int index = static_cast<int>(state_.base_from_pattern.size());
      state_.base_from_pattern.emplace_back(pose->camera_from_pattern.rotation(),
                                            pose->camera_from_pattern.translation());
      state_.jitter_rad.push_back(0.0);
      std::string number = std::filesystem::path(image.name).stem().string();
      number = number.substr(std::string("img_target").size());
      const auto own = ProfilesOf(kFolder / ("laser_target" + number + ".xyz"), index);
      profiles_.insert(profiles_.end(), own.begin(), own.end());
    }
    ASSERT_GE(state_.base_from_pattern.size(), 14u);
  }

  BoardMount mount_;
  ChainState state_;
  std::vector<LidarProfile> profiles_;
};

TEST_F(Lcct, PlanesFitWithinThreeAndAHalfMillimetresFromRoughPriors) {
  for (int direction = 0; direction < 3; ++direction) {
    Eigen::Matrix<double, 6, 1> off = Eigen::Matrix<double, 6, 1>::Zero();
    off[direction] = RadiansFromDegrees(2.0);
    off[3 + direction] = 0.040;
    state_.camera_from_lidar = Perturbed(PublishedLidar(), off);
    const auto found = CalibrateLidar(mount_, state_, profiles_, {}, {});
    ASSERT_TRUE(found) << found.error().message;
    std::cout << fmt::format(
        "{} returns in {} lines: plane rms {:.2f} mm, along the beams {:.2f} mm\n", found->returns,
        found->hits.size(), 1000.0 * found->plane_rms_m, 1000.0 * found->range_rms_m);
    // The study's own answer is 3.2 mm. The published pose is no truth: this lens of 23 deg leaves
    // the principal point open by 50 px.
    EXPECT_LE(1000.0 * found->plane_rms_m, 3.5) << "prior " << direction;
    EXPECT_GT(found->returns, 10000);
  }
}

}  // namespace
}  // namespace foresight
