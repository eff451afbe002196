#pragma once

#include "core/base/image.h"
#include "core/calibration/calibration_session.h"

namespace foresight {

/// The boards of a mount in one image, quickly (SearchEffort::kQuick); one that was not found is
/// missing. Of two checkerboards all grids of the image are looked at together: grids that stand to
/// each other as the boards were drawn are preferred, and a grid that could be what is left of the
/// other board, cut off by the image's border or covered, is taken only where the other board is
/// found too or a white margin shows that no square is missing. Two that look the same are not
/// found. `camera` may be known roughly.
/// @pre mount.Check()
MountView DetectMount(const GrayImage& image, const BoardMount& mount, const CameraModel& camera);

}  // namespace foresight
