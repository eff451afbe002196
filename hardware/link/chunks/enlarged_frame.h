#pragma once

#include <memory>

#include "hardware/link/chunks/frame_items.h"

namespace foresight {

/// The frame with its image in the size that it was taken in, for a look before the real one comes;
/// as it travelled where that size is none that an image can have.
std::shared_ptr<const CameraFrame> EnlargedFrame(const FrameItem& item);

}  // namespace foresight
