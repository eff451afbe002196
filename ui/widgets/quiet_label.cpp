#include "ui/widgets/quiet_label.h"

#include <QPainter>

namespace foresight {
namespace {

const QColor kFaintText(164, 172, 182);
const QColor kCard(44, 49, 56);
const QColor kStrip(28, 31, 36);
constexpr int kNarrow_px = 40;

QColor ColorOf(QuietLabel::Ground ground, const QPalette& palette) {
  switch (ground) {
    case QuietLabel::Ground::kCard:
      return kCard;
    case QuietLabel::Ground::kStrip:
      return kStrip;
    case QuietLabel::Ground::kWindow:
      break;
  }
  return palette.color(QPalette::Window);
}

}  // namespace

QuietLabel::QuietLabel(Ground ground, QWidget* parent)
    : QWidget(parent),
      ground_color_(ColorOf(ground, palette())),
      text_color_(ground == Ground::kWindow ? kFaintText : palette().color(QPalette::WindowText)) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
}

void QuietLabel::SetText(const QString& text) {
  if (text == text_) return;
  text_ = text;
  setAccessibleName(text);
  setToolTip(text);
  update();
}

QSize QuietLabel::sizeHint() const {
  return {kNarrow_px, fontMetrics().height()};
}

void QuietLabel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), ground_color_);
  painter.setPen(text_color_);
  painter.drawText(rect(), Qt::AlignLeft | Qt::AlignVCenter,
                   fontMetrics().elidedText(text_, Qt::ElideRight, width()));
}

}  // namespace foresight
