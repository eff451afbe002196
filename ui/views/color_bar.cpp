#include "ui/views/color_bar.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

constexpr int kWidth_px = 86;
constexpr int kBarWidth_px = 18;
constexpr int kMargin_px = 12;
constexpr int kTallest_px = 300;
constexpr int kIntervals = 4;

}  // namespace

ColorBar::ColorBar(QWidget* parent) : QWidget(parent) {
  setFixedWidth(kWidth_px);
}

void ColorBar::Set(ColorMap map, const ValueRange& range, const QString& title) {
  map_ = map;
  range_ = range;
  title_ = title;
  setAccessibleName(tr("Colours: %1 to %2 %3").arg(range.low).arg(range.high).arg(title));
  update();
}

QStringList ColorBar::Labels() const {
  const int digits = range_.high - range_.low < 50.0 ? 2 : 0;
  const double step = std::pow(10.0, -digits);
  QStringList labels;
  for (int i = 0; i <= kIntervals; ++i) {
    const double value = range_.low + (range_.high - range_.low) * i / kIntervals;
    const double shown = std::round(value / step) * step + 0.0;  // nothing reads "-0.00"
    labels << QString::number(shown, 'f', digits);
  }
  return labels;
}

void ColorBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const int line = fontMetrics().height();
  const int bar_height = std::clamp(height() - 2 * kMargin_px - 2 * line, line, kTallest_px);
  const int top = (height() - bar_height + line) / 2;
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(QRect(0, top - line - line / 2 - 2, width(), line),
                   Qt::AlignLeft | Qt::AlignVCenter, QStringLiteral("  ") + title_);
  for (int y = 0; y < bar_height; ++y) {
    const Rgb8 color = ColorOf(map_, 1.0 - static_cast<double>(y) / std::max(1, bar_height - 1));
    painter.fillRect(kMargin_px, top + y, kBarWidth_px, 1, QColor(color.r, color.g, color.b));
  }
  const QStringList labels = Labels();
  // On a low bar only the ends, or these and the middle, can be read.
  const int room = bar_height / std::max(1, line);
  const int every = room > kIntervals ? 1 : room >= 2 ? kIntervals / 2 : kIntervals;
  for (int i = 0; i <= kIntervals; i += every) {
    const double fraction = static_cast<double>(i) / kIntervals;
    const int y = top + static_cast<int>((1.0 - fraction) * (bar_height - 1));
    const int x = kMargin_px + kBarWidth_px;
    painter.drawLine(x, y, x + 4, y);
    painter.drawText(QRect(x + 8, y - line / 2, width() - x - 8, line),
                     Qt::AlignLeft | Qt::AlignVCenter, labels[i]);
  }
}

}  // namespace foresight
