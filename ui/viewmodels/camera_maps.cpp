#include "ui/viewmodels/camera_maps.h"

#include <limits>

namespace foresight {

Result<CameraMaps> MakeCameraMaps(const CalibrationBoard& board, const ModelCalibration& model,
                                  double distance_m, const RunContext& context) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CameraMaps maps;
  maps.distance_m = distance_m;
  const CameraModel& camera = model.camera;
  if (model.covariance) {
    maps.uncertainty =
        ProjectionUncertainty(*model.covariance, camera.width, camera.height, distance_m);
    maps.uncertainty_at_infinity =
        ProjectionUncertainty(*model.covariance, camera.width, camera.height, kInfinity);
  }
  const auto halves = CalibrateHalves(BundleOf(board, model), model.warp_estimated, context);
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the maps were cancelled");
  if (halves) {
    maps.halves = DifferenceOfHalves(*halves, distance_m);
    maps.halves_at_infinity = DifferenceOfHalves(*halves, kInfinity);
  }
  return maps;
}

}  // namespace foresight
