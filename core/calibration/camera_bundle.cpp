#include "core/calibration/camera_bundle.h"

#include <cmath>
#include <limits>

namespace foresight {

int CameraBundle::CornerCount() const {
  std::size_t count = 0;
  for (const BoardView& view : views) count += view.pixels.size();
  return static_cast<int>(count);
}

std::vector<Eigen::Vector2d> ViewErrors(const CameraBundle& bundle, std::size_t view) {
  const BoardView& seen = bundle.views[view];
  std::vector<Eigen::Vector2d> errors;
  errors.reserve(seen.pixels.size());
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const auto pixel = bundle.camera.Project(bundle.poses[view] *
                                             bundle.board.Corner(seen.corner_ids[i], bundle.warp));
    errors.push_back(pixel ? Eigen::Vector2d(*pixel - seen.pixels[i])
                           : Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  return errors;
}

ErrorSummary SummarizeErrors(const std::vector<Eigen::Vector2d>& errors) {
  ErrorSummary summary;
  double sum = 0.0, squares = 0.0;
  for (const Eigen::Vector2d& error : errors) {
    sum += error.norm();
    squares += error.squaredNorm();
  }
  summary.corners = static_cast<int>(errors.size());
  if (errors.empty()) return summary;
  summary.mean_px = sum / summary.corners;
  summary.rms_px = std::sqrt(squares / summary.corners);
  return summary;
}

ErrorSummary SummarizeErrors(const CameraBundle& bundle) {
  std::vector<Eigen::Vector2d> all;
  for (std::size_t view = 0; view < bundle.views.size(); ++view) {
    const std::vector<Eigen::Vector2d> errors = ViewErrors(bundle, view);
    all.insert(all.end(), errors.begin(), errors.end());
  }
  return SummarizeErrors(all);
}

}  // namespace foresight
