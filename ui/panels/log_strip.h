#pragma once

#include <QFrame>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/log_model.h"

class QLabel;
class QPushButton;
class QToolButton;

namespace foresight {

/// One line under the head's strip, always there and always as high, so that nothing below it
/// moves: the weightiest message that is not acknowledged, a button that does what it advises where
/// a command can, and how many more there are.
class LogStrip : public QFrame {
  Q_OBJECT

 public:
  LogStrip(LogModel* log, CommandTable* commands, QWidget* parent = nullptr);
  /// What stands in it; empty while there is nothing.
  QString Text() const;

 private:
  void ShowTop();
  void ShowAction(const LogEntry* top);

  LogModel* log_;
  CommandTable* commands_;
  QLabel* icon_;
  QLabel* text_;
  QLabel* more_;
  QPushButton* action_;
  QPushButton* acknowledge_;
};

}  // namespace foresight
