#include "ui/views/sample_legend.h"

#include <QPainter>
#include <algorithm>

#include "core/pictures/sample_picture.h"
#include "ui/render/paint_mark.h"

namespace foresight {
namespace {

constexpr int kMargin_px = 8;
constexpr int kSymbolWidth_px = 22;

std::ptrdiff_t CountOf(const AlignedSamples& samples, RejectReason kind) {
  return std::count(samples.reasons.begin(), samples.reasons.end(), kind);
}

}  // namespace

QString NameOf(RejectReason kind) {
  switch (kind) {
    case RejectReason::kFlying:
      return SampleLegend::tr("Flying");
    case RejectReason::kIsolated:
      return SampleLegend::tr("Isolated");
    case RejectReason::kFlipping:
      return SampleLegend::tr("Flipping");
    case RejectReason::kKept:
      break;
  }
  return SampleLegend::tr("Kept samples");
}

SampleLegend::SampleLegend(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  hide();
}

void SampleLegend::Show(const AlignedSamples* samples, const SampleLayers& layers,
                        const AlignedSamples* second) {
  rows_.clear();
  int widest = 0;
  for (const RejectReason kind : kSampleKinds) {
    if (samples == nullptr || !layers.Shows(kind)) continue;
    QString count = QString::number(CountOf(*samples, kind));
    if (second != nullptr) count += QStringLiteral(" | %1").arg(CountOf(*second, kind));
    rows_.push_back({kind, tr("%1: %2").arg(NameOf(kind), count)});
    widest = std::max(widest, fontMetrics().horizontalAdvance(rows_.back().text));
  }
  resize(widest + kSymbolWidth_px + 2 * kMargin_px,
         static_cast<int>(rows_.size()) * (fontMetrics().height() + 2) + kMargin_px);
  setVisible(!rows_.isEmpty());
  update();
}

void SampleLegend::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(20, 22, 26, 215));
  painter.drawRoundedRect(rect(), 4, 4);
  const int line = fontMetrics().height() + 2;
  int top = kMargin_px / 2;
  for (const Row& row : rows_) {
    PaintMark(&painter, row.kind, ColorOf(row.kind),
              QPointF(kMargin_px + MarkSize().half_px, top + 0.5 * line));
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRect(kMargin_px + kSymbolWidth_px, top, width(), line),
                     Qt::AlignLeft | Qt::AlignVCenter, row.text);
    top += line;
  }
}

}  // namespace foresight
