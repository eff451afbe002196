#include "ui/views/difference_histogram.h"

#include <QPainter>
#include <algorithm>

#include "core/pictures/color_map.h"

namespace foresight {

DifferenceHistogram::DifferenceHistogram(QWidget* parent) : QWidget(parent) {
  setMinimumSize(160, 110);
}

void DifferenceHistogram::Set(const DepthComparison& comparison) {
  bins_ = comparison.histogram;
  below_ = comparison.below_histogram;
  above_ = comparison.above_histogram;
  setAccessibleName(tr("Pixels by difference of depth, B minus A"));
  update();
}

void DifferenceHistogram::paintEvent(QPaintEvent*) {
  constexpr int kMargin_px = 8;
  QPainter painter(this);
  const int line = fontMetrics().height();
  const int left = kMargin_px, right = width() - kMargin_px;
  const int top = kMargin_px + line, bottom = height() - kMargin_px - 2 * line;
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(left, top - line / 3, tr("pixels"));
  const auto most = std::max<std::int64_t>(1, *std::max_element(bins_.begin(), bins_.end()));
  const double bin_px = static_cast<double>(right - left) / static_cast<double>(bins_.size());
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const double middle = (static_cast<double>(i) + 0.5) / static_cast<double>(bins_.size());
    const Rgb8 color = ColorOf(ColorMap::kBalance, middle);
    const double tall = static_cast<double>(bins_[i]) / static_cast<double>(most) * (bottom - top);
    painter.fillRect(QRectF(left + bin_px * static_cast<double>(i), bottom - tall, bin_px, tall),
                     QColor(color.r, color.g, color.b));
  }
  painter.drawLine(left, bottom, right, bottom);
  const double scale_mm = 1000.0 * DepthComparison::kFullScale_m;
  for (const double fraction : {0.0, 0.5, 1.0}) {
    const QString text = QString::number(scale_mm * (2.0 * fraction - 1.0), 'f', 0);
    const int wide = fontMetrics().horizontalAdvance(text);
    const int x = left + static_cast<int>(fraction * (right - left));
    painter.drawText(std::clamp(x - wide / 2, left, right - wide), bottom + line, text);
  }
  painter.drawText(left, bottom + 2 * line,
                   tr("B - A, mm; beyond: %1 and %2").arg(below_).arg(above_));
}

}  // namespace foresight
