#include "ui/views/corner_tags.h"

#include <QEvent>
#include <QLabel>

#include "ui/views/sample_legend.h"

namespace foresight {
namespace {

constexpr int kTagMargin_px = 8;

QLabel* Tag(QWidget* canvas) {
  auto* tag = new QLabel(canvas);
  tag->setObjectName(QStringLiteral("cornerTag"));
  tag->setAttribute(Qt::WA_TransparentForMouseEvents);
  tag->hide();
  return tag;
}

void SetText(QLabel* tag, const QString& text) {
  tag->setText(text);
  tag->adjustSize();
  tag->setVisible(!text.isEmpty());
}

}  // namespace

CornerTags::CornerTags(QWidget* canvas)
    : QObject(canvas),
      canvas_(canvas),
      top_left_(Tag(canvas)),
      top_right_(Tag(canvas)),
      legend_(new SampleLegend(canvas)) {
  canvas->installEventFilter(this);
}

void CornerTags::SetTopLeft(const QString& text) {
  SetText(top_left_, text);
  Place();
}

void CornerTags::SetTopRight(const QString& text) {
  SetText(top_right_, text);
  Place();
}

void CornerTags::SetLegend(const AlignedSamples* samples, const SampleLayers& layers,
                           const AlignedSamples* second) {
  legend_->Show(samples, layers, second);
  Place();
}

bool CornerTags::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) Place();
  return QObject::eventFilter(watched, event);
}

void CornerTags::Place() {
  top_left_->move(kTagMargin_px, kTagMargin_px);
  top_right_->move(canvas_->width() - top_right_->width() - kTagMargin_px, kTagMargin_px);
  legend_->move(kTagMargin_px, canvas_->height() - legend_->height() - kTagMargin_px);
}

}  // namespace foresight
