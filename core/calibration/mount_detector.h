#pragma once

#include "core/base/image.h"
#include "core/calibration/calibration_session.h"

namespace foresight {

/// The boards of a mount in one image, quickly (SearchEffort::kQuick); one that was not found is
/// missing. Of two checkerboards all grids of the image are looked at together: grids that stand to
/// each other as the boards were drawn are preferred, and a grid that could be what is left of the
/// other board, cut off by the image's border or covered, is taken only where the other board is
/// found too or a white margin shows that no square is missing. A checkerboard that looks the same
/// upside down is taken only together with the other one, which tells its upper side. A board
/// whose corners were found but whose squares are overexposed, blurred or without contrast is not
/// taken, and `fault` says so; where no corners were found it says what is wrong with the image, if
/// there is no board in it at all. `camera` may be known roughly.
/// Where CheckInImages fails nothing is found.
/// @pre mount.Check()
MountView DetectMount(const GrayImage& image, const BoardMount& mount, const CameraModel& camera);

/// Whether images tell which board of a mount is which, and which way up. Fails with
/// kInvalidOptions, saying which boards do.
Status CheckInImages(const BoardMount& mount);

}  // namespace foresight
