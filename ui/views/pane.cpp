#include "ui/views/pane.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStackedLayout>
#include <QVBoxLayout>

#include "ui/views/color_bar.h"
#include "ui/views/vtk_canvas.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

constexpr int kControlHeight_px = 28;  // the same in every pane, so that canvases align

}  // namespace

Pane::Pane(QWidget* canvas, const QString& hint, QWidget* parent)
    : QWidget(parent), canvas_(canvas) {
  hint_ = new QLabel(hint);
  hint_->setObjectName(QStringLiteral("emptyState"));
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  // It may need three lines of a narrow pane; on a low screen a lower pane is better than a window
  // that is too high.
  hint_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
  caption_ = new QuietLabel(QuietLabel::Ground::kWindow);

  controls_ = new QHBoxLayout;
  controls_->setContentsMargins(8, 4, 8, 4);
  controls_->setSpacing(8);
  auto* holder = new QWidget;
  // The canvas lies under the hint from the start, so that OpenGL's second of first steps is over
  // before the first scan.
  auto* stack = new QStackedLayout(holder);
  stack->setStackingMode(QStackedLayout::StackAll);
  stack->addWidget(hint_);
  auto* shown = new QWidget;
  colors_ = new ColorBar;
  colors_->hide();
  auto* row = new QHBoxLayout(shown);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  row->addWidget(canvas_, 1);
  row->addWidget(colors_);
  stack->addWidget(shown);
  stack->setCurrentWidget(hint_);
  footer_ = new QVBoxLayout;

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  caption_->setFixedHeight(kControlHeight_px);
  controls_->addWidget(caption_, 1);
  layout->addLayout(controls_);
  layout->addWidget(holder, 1);
  layout->addLayout(footer_);
}

void Pane::ShowCanvas(bool show) {
  hint_->setVisible(!show);
  // A cloud of half a million points under a hint would be drawn for nobody.
  if (auto* canvas = qobject_cast<VtkCanvas*>(canvas_)) canvas->SetCovered(!show);
}

bool Pane::HintShown() const {
  return hint_->isVisible();
}

void Pane::SetHint(const QString& hint) {
  hint_->setText(hint);
}

QString Pane::Caption() const {
  return caption_->Text();
}

void Pane::SetCaption(const QString& caption, const QString& details) {
  caption_->SetText(caption);
  caption_->setToolTip(details.isEmpty() ? caption : details);
}

}  // namespace foresight
