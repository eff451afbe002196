#pragma once

#include <QVector>
#include <QWidget>

#include "ui/viewmodels/task_runner.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace foresight {

/// In the status bar: the running task, how far it has got, and a button to cancel it. With several
/// at once the one added first is shown.
class TaskStrip : public QWidget {
  Q_OBJECT

 public:
  explicit TaskStrip(const QVector<TaskRunner*>& runners, QWidget* parent = nullptr);

 private:
  TaskRunner* Busy() const;
  void ShowProgress();

  QVector<TaskRunner*> runners_;
  QLabel* text_;
  QProgressBar* bar_;
  QPushButton* cancel_;
};

}  // namespace foresight
