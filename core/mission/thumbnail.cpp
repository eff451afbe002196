#include "core/mission/thumbnail.h"

#include "core/base/shrink_image.h"
#include "core/io/png.h"

namespace foresight {

Result<std::string> ThumbnailOf(const ColorImage& image) {
  // 48 x 48 pixels of pure noise take 7 kB.
  for (const int side : {128, 96, 72, 60, 48}) {
    FORESIGHT_TRY(std::string png, EncodePng(ShrinkImage(image, side), PngContent::kCapture));
    if (png.size() <= kMaxThumbnailBytes) return png;
  }
  return Fail(ErrorCode::kInvalidInput, "a thumbnail of {} x {} pixels takes more than {} bytes",
              image.width(), image.height(), kMaxThumbnailBytes);
}

}  // namespace foresight
