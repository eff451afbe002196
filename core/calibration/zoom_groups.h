#pragma once

#include <optional>
#include <vector>

#include "core/calibration/camera_bundle.h"

namespace foresight {

/// How much longer the focal length is that one image asks for, pose and focal length free, the
/// camera's other values as they are.
struct ViewFocal {
  double log_ratio = 0.0;
  double sigma = 0.0;  ///< by the errors of its corners; infinite where the image does not say
};
std::vector<ViewFocal> FocalOfEachView(const CameraBundle& bundle);

/// Images that ask for two focal lengths: the zoom or the focus was changed between them.
struct ZoomGroups {
  std::vector<std::size_t> shorter, longer;  ///< views, by the focal length they ask for
  double ratio = 1.0;                        ///< of the two focal lengths, above 1
  double gap = 0.0;                          ///< between the groups' means, by their spread
};

/// nullopt where the images agree, or scatter without falling apart into two groups. Images that
/// know their focal length to 3 % or worse belong to no group.
std::optional<ZoomGroups> FindZoomGroups(const std::vector<ViewFocal>& focals);

}  // namespace foresight
