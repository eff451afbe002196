#pragma once

#include "core/calibration/camera_bundle.h"
#include "core/calibration/lens_model.h"

namespace foresight {

/// Adjusts another model's lens, from a bundle that is nearly right; the options' free_lens is
/// not asked. A k below 0.05 becomes 0, a pinhole. Fails with kNoConvergence where the model cannot
/// show the corners at all.
Result<CameraBundle> FitLens(const CameraBundle& near, LensModel model,
                             const BundleOptions& options, const RunContext& context);

/// Camera, warp and poses from every second view, beginning with `first` (0 or 1). `bundle` is
/// nearly right. Fails with kNoConvergence and kCancelled.
Result<CameraBundle> FitEverySecond(const CameraBundle& bundle, std::size_t first, bool free_warp,
                                    const RunContext& context);

/// Mean distance in views that were not used: camera and warp from every second view, poses alone
/// fitted in the others, and the reverse. A corner that the lens does not show counts as 200 px.
/// NaN where a half has fewer than 2 views or does not converge. Fails with kCancelled only.
Result<double> CrossValidate(const CameraBundle& bundle, bool free_warp, const RunContext& context);

}  // namespace foresight
