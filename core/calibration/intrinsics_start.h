#pragma once

#include "core/calibration/camera_bundle.h"

namespace foresight {

/// A bundle of those views that a camera explains at all.
struct IntrinsicsStart {
  CameraBundle bundle;
  std::vector<std::size_t> views;  ///< which of the given views the bundle has
};

/// A camera with the paper's lens and a pose a view, from the corners alone: no focal length is
/// guessed by the caller. Fields of view from 10 to 200 deg are tried on some of the views, the
/// best ones are adjusted with a loss that forgives wrong corners, and the best of those is the
/// start. A view without a pose, or 50 px off in every one, is left out. Fails with kNoConvergence
/// where nothing explains at least half of the views.
Result<IntrinsicsStart> FindIntrinsicsStart(const CalibrationBoard& board,
                                            const std::vector<BoardView>& views, int width,
                                            int height, const RunContext& context);

/// The bundle seen through another camera: each pose is refined there, or found anew. Fails with
/// kNoConvergence where a view has no pose or corners outside of the lens's domain.
Result<CameraBundle> WithCamera(const CameraBundle& bundle, const CameraModel& camera);

}  // namespace foresight
