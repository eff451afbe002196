#pragma once

namespace foresight {

/// The longest side of an image that is read or written, in pixels. A longer one in a file is a
/// damaged header or an attempt to fill the memory.
inline constexpr int kMaxImageSide = 20000;

}  // namespace foresight
