#include "ui/panels/task_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <algorithm>

namespace foresight {

TaskStrip::TaskStrip(const QVector<TaskRunner*>& runners, QWidget* parent)
    : QWidget(parent),
      runners_(runners),
      text_(new QLabel),
      bar_(new QProgressBar),
      cancel_(new QPushButton(tr("Cancel"))) {
  bar_->setRange(0, 1000);
  bar_->setFixedSize(220, 10);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 2, 12, 2);
  layout->setSpacing(12);
  layout->addWidget(text_);
  layout->addWidget(bar_);
  layout->addWidget(cancel_);
  layout->addStretch(1);
  setFixedHeight(36);  // the same with and without a task, or everything above would jump
  connect(cancel_, &QPushButton::clicked, this, [this] {
    if (TaskRunner* runner = Busy()) runner->cancel();
  });
  for (TaskRunner* runner : runners_)
    connect(runner, &TaskRunner::changed, this, &TaskStrip::ShowProgress);
  ShowProgress();
}

TaskRunner* TaskStrip::Busy() const {
  const auto busy = std::find_if(runners_.begin(), runners_.end(),
                                 [](const TaskRunner* runner) { return runner->Busy(); });
  return busy == runners_.end() ? nullptr : *busy;
}

void TaskStrip::ShowProgress() {
  const TaskRunner* runner = Busy();
  bar_->setVisible(runner != nullptr);
  cancel_->setVisible(runner != nullptr);
  if (runner == nullptr) {
    text_->setText(tr("Nothing to compute"));  // "ready" is a word for the head
    return;
  }
  bar_->setValue(runner->Permille());
  text_->setText(runner->Stage().isEmpty() ? runner->Title()
                                           : tr("%1: %2").arg(runner->Title(), runner->Stage()));
}

}  // namespace foresight
