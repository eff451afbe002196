#include "ui/widgets/quiet_label.h"

#include <QPainter>

namespace foresight {
namespace {

const QColor kFaintText(164, 172, 182);
const QColor kCard(44, 49, 56);
constexpr int kNarrow_px = 40;

}  // namespace

QuietLabel::QuietLabel(Ground ground, QWidget* parent)
    : QWidget(parent),
      ground_color_(ground == Ground::kCard ? kCard : palette().color(QPalette::Window)),
      text_color_(ground == Ground::kCard ? palette().color(QPalette::WindowText) : kFaintText) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
}

void QuietLabel::SetText(const QString& text) {
  if (text == text_) return;
  text_ = text;
  setAccessibleName(text);
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
