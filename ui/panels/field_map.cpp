#include "ui/panels/field_map.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "core/pictures/color_map.h"

namespace foresight {
namespace {

constexpr int kLegend_px = 18;

QColor ColorOfFraction(double fraction) {
  const Rgb8 color = ColorOf(ColorMap::kCividis, fraction);
  return {color.r, color.g, color.b};
}

}  // namespace

FieldMap::FieldMap(QWidget* parent) : QWidget(parent) {
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

int FieldMap::heightForWidth(int width) const {
  return kLegend_px + (field_.image_width > 0 ? width * field_.image_height / field_.image_width
                                              : width * 3 / 4);
}

void FieldMap::Show(const ImageField& field, double full) {
  field_ = field;
  full_ = full;
  setToolTip(tr("Median %1 px, largest %2 px")
                 .arg(field.Median(), 0, 'f', 2)
                 .arg(field.Largest(), 0, 'f', 2));
  updateGeometry();
  update();
}

void FieldMap::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRect room(0, 0, width(), height() - kLegend_px);
  painter.fillRect(room, QColor(28, 31, 36));
  for (int row = 0; row < field_.rows; ++row)
    for (int column = 0; column < field_.columns; ++column) {
      const double value = field_.At(column, row);
      if (!std::isfinite(value)) continue;
      const int left = column * room.width() / field_.columns;
      const int right = (column + 1) * room.width() / field_.columns;
      const int top = row * room.height() / field_.rows;
      const int bottom = (row + 1) * room.height() / field_.rows;
      painter.fillRect(left, top, right - left, bottom - top, ColorOfFraction(value / full_));
    }
  QFont small = font();
  small.setPointSizeF(0.8 * small.pointSizeF());
  painter.setFont(small);
  painter.setPen(palette().color(QPalette::PlaceholderText));
  const QRect legend(0, room.bottom() + 3, width(), kLegend_px - 3);
  painter.drawText(legend, Qt::AlignLeft | Qt::AlignVCenter, tr("0"));
  painter.drawText(legend, Qt::AlignRight | Qt::AlignVCenter, tr("%1 px and more").arg(full_));
  const int left = 14, bar = std::max(1, width() - 120);
  for (int x = 0; x < bar; ++x) {
    painter.setPen(ColorOfFraction(static_cast<double>(x) / bar));
    painter.drawLine(left + x, legend.top() + 4, left + x, legend.bottom() - 3);
  }
}

}  // namespace foresight
