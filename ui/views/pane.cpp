#include "ui/views/pane.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStackedLayout>
#include <QVBoxLayout>

namespace foresight {

Pane::Pane(QWidget* canvas, const QString& hint, QWidget* parent)
    : QWidget(parent), canvas_(canvas) {
  hint_ = new QLabel(hint);
  hint_->setObjectName(QStringLiteral("emptyState"));
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setWordWrap(true);
  caption_ = new QLabel;
  caption_->setObjectName(QStringLiteral("caption"));

  controls_ = new QHBoxLayout;
  controls_->setContentsMargins(8, 4, 8, 4);
  controls_->setSpacing(8);
  auto* holder = new QWidget;
  stack_ = new QStackedLayout(holder);
  stack_->addWidget(hint_);
  stack_->addWidget(canvas_);
  footer_ = new QVBoxLayout;
  footer_->setContentsMargins(8, 4, 8, 4);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  controls_->addWidget(caption_, 1);
  layout->addLayout(controls_);
  layout->addWidget(holder, 1);
  layout->addLayout(footer_);
}

void Pane::ShowCanvas(bool show) {
  stack_->setCurrentWidget(show ? canvas_ : hint_);
}

void Pane::SetHint(const QString& hint) {
  hint_->setText(hint);
}

void Pane::SetCaption(const QString& caption) {
  caption_->setText(caption);
}

}  // namespace foresight
