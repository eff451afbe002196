#include "ui/render/qimage_of.h"

namespace foresight {

QImage QImageOf(const ColorImage& image) {
  if (image.empty()) return {};
  static_assert(sizeof(Rgb8) == 3);
  const QImage borrowed(reinterpret_cast<const uchar*>(image.data()), image.width(), image.height(),
                        image.width() * 3, QImage::Format_RGB888);
  return borrowed.copy();
}

}  // namespace foresight
