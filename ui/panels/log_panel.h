#pragma once

#include <QWidget>

#include "ui/viewmodels/log_model.h"

class QTreeWidget;

namespace foresight {

/// Everything the operator was told, newest on top.
class LogPanel : public QWidget {
  Q_OBJECT

 public:
  explicit LogPanel(LogModel* log, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void ShowEntries();

  LogModel* log_;
  QTreeWidget* list_;
};

}  // namespace foresight
