#pragma once

#include <QVector>
#include <QWidget>

#include "ui/viewmodels/task_queue.h"

class QHBoxLayout;
class QLabel;
class QProgressBar;
class QToolButton;

namespace foresight {

/// In the status bar: every task that runs or waits, each with how far it has got and a button that
/// cancels it. Always as high.
class TaskStrip : public QWidget {
  Q_OBJECT

 public:
  explicit TaskStrip(TaskQueue* tasks, QWidget* parent = nullptr);

 private:
  struct Row {
    quint64 id = 0;
    QWidget* whole = nullptr;
    QLabel* text = nullptr;
    QProgressBar* bar = nullptr;
    QToolButton* cancel = nullptr;
  };
  void ShowTasks();
  Row MakeRow();

  TaskQueue* tasks_;
  QHBoxLayout* layout_;
  QLabel* idle_;
  QVector<Row> rows_;
};

}  // namespace foresight
