#include "ui/panels/task_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

#include "ui/panels/theme.h"

namespace foresight {

TaskStrip::TaskStrip(TaskQueue* tasks, QWidget* parent)
    : QWidget(parent), tasks_(tasks), layout_(new QHBoxLayout(this)), idle_(new QLabel) {
  layout_->setContentsMargins(12, 0, 12, 0);
  layout_->setSpacing(16);
  layout_->setSizeConstraint(QLayout::SetNoConstraint);
  idle_->setText(tr("Nothing to compute"));  // "ready" is a word for the head
  layout_->addWidget(idle_);
  layout_->addStretch(1);
  setFixedHeight(30);  // the same with and without a task, or everything above would jump
  setMinimumWidth(0);
  connect(tasks_, &TaskQueue::changed, this, &TaskStrip::ShowTasks);
  ShowTasks();
}

TaskStrip::Row TaskStrip::MakeRow() {
  Row row;
  row.whole = new QWidget;
  row.text = new QLabel;
  row.bar = new QProgressBar;
  row.bar->setRange(0, 1000);
  row.bar->setFixedSize(110, 10);
  row.bar->setTextVisible(false);
  row.bar->setAccessibleName(tr("Progress"));
  row.cancel = new QToolButton;
  row.cancel->setIcon(Icon("abort"));
  row.cancel->setAutoRaise(true);
  auto* layout = new QHBoxLayout(row.whole);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  for (QWidget* part : {static_cast<QWidget*>(row.text), static_cast<QWidget*>(row.bar),
                        static_cast<QWidget*>(row.cancel)})
    layout->addWidget(part);
  layout_->insertWidget(layout_->count() - 1, row.whole);
  const int at = rows_.size();
  connect(row.cancel, &QToolButton::clicked, this, [this, at] { tasks_->cancel(rows_[at].id); });
  return row;
}

void TaskStrip::ShowTasks() {
  const QVector<TaskInfo> tasks = tasks_->Tasks();
  while (rows_.size() < tasks.size()) rows_ << MakeRow();
  for (int i = 0; i < rows_.size(); ++i) {
    Row& row = rows_[i];
    row.whole->setVisible(i < tasks.size());
    if (i >= tasks.size()) continue;
    const TaskInfo& task = tasks[i];
    row.id = task.id;
    row.text->setText(!task.running          ? tr("%1: waiting").arg(task.title)
                      : task.stage.isEmpty() ? task.title
                                             : tr("%1: %2").arg(task.title, task.stage));
    row.bar->setValue(task.permille);
    row.cancel->setVisible(task.cancellable);
    row.cancel->setToolTip(tr("Cancel: %1").arg(task.title));
    row.cancel->setAccessibleName(row.cancel->toolTip());
  }
  idle_->setVisible(tasks.isEmpty());
}

}  // namespace foresight
