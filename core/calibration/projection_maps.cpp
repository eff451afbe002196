#include "core/calibration/projection_maps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/quantile.h"
#include "core/calibration/fit_lens.h"
#include "core/geometry/nearest_rotation.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

ImageField FieldOf(int width, int height, MapSize size,
                   const std::function<double(const Eigen::Vector2d&)>& value) {
  ImageField field{width, height, size.columns, size.rows};
  for (int row = 0; row < size.rows; ++row)
    for (int column = 0; column < size.columns; ++column)
      field.values.push_back(value(field.Middle(column, row)));
  return field;
}

std::vector<double> Finite(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  return finite;
}

/// The even camera's frame seen from the odd one's: what both see in the corners' pixels is the
/// same there.
Eigen::Isometry3d EvenFromOdd(const CameraHalves& halves, double distance_m) {
  const bool at_infinity = std::isinf(distance_m);
  Eigen::Matrix3Xd odd(3, static_cast<Eigen::Index>(halves.pixels.size()));
  Eigen::Matrix3Xd even = odd;
  Eigen::Index count = 0;
  for (const Eigen::Vector2d& pixel : halves.pixels) {
    const auto from = halves.odd.Unproject(pixel);
    const auto to = halves.even.Unproject(pixel);
    if (!from || !to) continue;
    odd.col(count) = *from;
    even.col(count++) = *to;
  }
  Eigen::Isometry3d even_from_odd = Eigen::Isometry3d::Identity();
  if (count < 3) return even_from_odd;
  // Directions turn about the camera, not about their mean.
  Eigen::Vector3d odd_mean = Eigen::Vector3d::Zero(), even_mean = Eigen::Vector3d::Zero();
  if (!at_infinity) {
    odd_mean = odd.leftCols(count).rowwise().mean();
    even_mean = even.leftCols(count).rowwise().mean();
  }
  even_from_odd.linear() = NearestRotation((even.leftCols(count).colwise() - even_mean) *
                                           (odd.leftCols(count).colwise() - odd_mean).transpose());
  if (!at_infinity)
    even_from_odd.translation() = distance_m * (even_mean - even_from_odd.linear() * odd_mean);
  return even_from_odd;
}

}  // namespace

Eigen::Vector2d ImageField::Middle(int column, int row) const {
  return {(column + 0.5) * image_width / columns - 0.5, (row + 0.5) * image_height / rows - 0.5};
}

double ImageField::Median() const {
  return UpperMedian(Finite(values));
}

double ImageField::Largest() const {
  const std::vector<double> finite = Finite(values);
  return finite.empty() ? kUnseen : *std::max_element(finite.begin(), finite.end());
}

ImageField ProjectionUncertainty(const BundleCovariance& covariance, int width, int height,
                                 double distance_m, MapSize size) {
  return FieldOf(width, height, size, [&](const Eigen::Vector2d& pixel) {
    const auto square = covariance.OfProjection(pixel, distance_m);
    if (!square) return kUnseen;
    return std::sqrt(std::max(0.0, EigenOf(*square).values[1]));
  });
}

CameraBundle BundleOf(const CalibrationBoard& board, const ModelCalibration& model) {
  CameraBundle bundle;
  bundle.board = board;
  bundle.camera = model.camera;
  bundle.warp = model.warp;
  for (const ImageErrors& image : model.images) {
    bundle.views.push_back({image.corner_ids, image.pixels});
    bundle.poses.push_back(image.camera_from_pattern);
  }
  return bundle;
}

Result<CameraHalves> CalibrateHalves(const CameraBundle& bundle, bool free_warp,
                                     const RunContext& context) {
  if (bundle.views.size() < 4)
    return Fail(ErrorCode::kTooFewPoints,
                "odd against even images: {} images are too few, at least 4 are needed",
                bundle.views.size());
  CameraHalves halves;
  FORESIGHT_TRY(const CameraBundle odd, FitEverySecond(bundle, 0, free_warp, context));
  FORESIGHT_TRY(const CameraBundle even, FitEverySecond(bundle, 1, free_warp, context));
  halves.odd = odd.camera;
  halves.even = even.camera;
  for (const BoardView& view : bundle.views)
    halves.pixels.insert(halves.pixels.end(), view.pixels.begin(), view.pixels.end());
  return halves;
}

ImageField DifferenceOfHalves(const CameraHalves& halves, double distance_m, MapSize size) {
  const Eigen::Isometry3d even_from_odd = EvenFromOdd(halves, distance_m);
  const double length = std::isinf(distance_m) ? 1.0 : distance_m;
  return FieldOf(halves.odd.width, halves.odd.height, size, [&](const Eigen::Vector2d& pixel) {
    const auto ray = halves.odd.Unproject(pixel);
    if (!ray) return kUnseen;
    const auto seen = halves.even.Project(even_from_odd * Eigen::Vector3d(length * *ray));
    return seen ? (*seen - pixel).norm() : kUnseen;
  });
}

}  // namespace foresight
