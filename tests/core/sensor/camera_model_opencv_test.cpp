// A foreign judge: OpenCV's own projections of the models that it has.
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "core/base/random.h"
#include "core/sensor/camera_model.h"

namespace foresight {
namespace {

CameraModel With(const Lens& lens) {
  return {.width = 1280,
          .height = 960,
          .fx = 612.0,
          .fy = 609.5,
          .cx = 641.3,
          .cy = 477.9,
          .lens = lens};
}

cv::Matx33d MatrixOf(const CameraModel& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

std::vector<cv::Point3d> PointsInFront() {
  Random random(7);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i)
    points.emplace_back(random.Uniform(-1.0, 1.0), random.Uniform(-0.8, 0.8),
                        random.Uniform(1.0, 3.0));
  return points;
}

/// The columns of OpenCV's derivatives: rows 2 i and 2 i + 1 belong to point i.
void ExpectSameDerivatives(const Eigen::Ref<const Eigen::MatrixXd>& ours, const cv::Mat& theirs,
                           std::size_t point, int first_column) {
  for (int column = 0; column < ours.cols(); ++column)
    for (int row = 0; row < 2; ++row) {
      const double expected =
          theirs.at<double>(2 * static_cast<int>(point) + row, first_column + column);
      ASSERT_NEAR(ours(row, column), expected, 1e-9 * (1.0 + std::abs(expected)))
          << "row " << row << ", column " << column;
    }
}

TEST(RadialTangentialLens, IsThatOfOpenCv) {
  const CameraModel camera = With(RadialTangentialLens(-0.31, 0.12, 1.3e-3, -7e-4, -0.02));
  const std::vector<cv::Point3d> points = PointsInFront();
  std::vector<cv::Point2d> pixels;
  cv::Mat derivatives;
  const cv::Vec<double, 5> distortion(-0.31, 0.12, 1.3e-3, -7e-4, -0.02);
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), MatrixOf(camera), distortion, pixels,
                    derivatives);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CameraModel::ByPoint by_point;
    CameraModel::ByParameters by_parameters;
    const auto pixel =
        camera.Project({points[i].x, points[i].y, points[i].z}, &by_point, &by_parameters);
    ASSERT_TRUE(pixel);
    ASSERT_NEAR(pixel->x(), pixels[i].x, 1e-9);
    ASSERT_NEAR(pixel->y(), pixels[i].y, 1e-9);
    // OpenCV's columns: rotation, translation, focal lengths, principal point, k1 k2 p1 p2 k3.
    ExpectSameDerivatives(by_point, derivatives, i, 3);
    ExpectSameDerivatives(by_parameters, derivatives, i, 6);
  }
}

TEST(RadialTangentialLens, UndistortsAsOpenCvDoes) {
  const CameraModel camera = With(RadialTangentialLens(-0.2, 0.05, 1.3e-3, -7e-4, 0.0));
  std::vector<cv::Point2d> pixels, slopes;
  for (double u = 200.0; u < 1100.0; u += 50.0) pixels.emplace_back(u, 0.7 * u + 20.0);
  cv::undistortPoints(pixels, slopes, MatrixOf(camera),
                      cv::Vec<double, 5>(-0.2, 0.05, 1.3e-3, -7e-4, 0.0), cv::noArray(),
                      cv::noArray(), cv::TermCriteria(cv::TermCriteria::COUNT, 500, 0.0));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto slope = camera.UnprojectToPlane({pixels[i].x, pixels[i].y});
    ASSERT_TRUE(slope);
    EXPECT_NEAR(slope->x(), slopes[i].x, 1e-12);
    EXPECT_NEAR(slope->y(), slopes[i].y, 1e-12);
  }
}

TEST(KannalaBrandtLens, IsThatOfOpenCv) {
  const CameraModel camera = With(KannalaBrandtLens(-0.0127, 0.0201, -0.0124, 0.0017));
  const std::vector<cv::Point3d> points = PointsInFront();
  std::vector<cv::Point2d> pixels;
  cv::Mat derivatives;
  cv::fisheye::projectPoints(points, pixels, cv::Vec3d(), cv::Vec3d(), MatrixOf(camera),
                             cv::Vec4d(-0.0127, 0.0201, -0.0124, 0.0017), 0.0, derivatives);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CameraModel::ByPoint by_point;
    CameraModel::ByParameters by_parameters;
    const auto pixel =
        camera.Project({points[i].x, points[i].y, points[i].z}, &by_point, &by_parameters);
    ASSERT_TRUE(pixel);
    ASSERT_NEAR(pixel->x(), pixels[i].x, 1e-9);
    ASSERT_NEAR(pixel->y(), pixels[i].y, 1e-9);
    // OpenCV's columns: focal lengths, principal point, k1 to k4, rotation, translation, skew.
    ExpectSameDerivatives(by_parameters, derivatives, i, 0);
    ExpectSameDerivatives(by_point, derivatives, i, 11);
  }
}

TEST(KannalaBrandtLens, UndistortsAsOpenCvDoes) {
  const cv::Vec4d distortion(-0.0127, 0.0201, -0.0124, 0.0017);
  const CameraModel camera = With(KannalaBrandtLens(-0.0127, 0.0201, -0.0124, 0.0017));
  std::vector<cv::Point2d> pixels, slopes;
  for (double u = 10.0; u < 1270.0; u += 30.0) pixels.emplace_back(u, 0.7 * u + 20.0);
  cv::fisheye::undistortPoints(pixels, slopes, MatrixOf(camera), distortion);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto slope = camera.UnprojectToPlane({pixels[i].x, pixels[i].y});
    ASSERT_TRUE(slope);
    // OpenCV stops where its step is below 1e-8 rad.
    EXPECT_NEAR(slope->x(), slopes[i].x, 1e-7);
    EXPECT_NEAR(slope->y(), slopes[i].y, 1e-7);
  }
}

}  // namespace
}  // namespace foresight
