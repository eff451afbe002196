#pragma once

#include <QFrame>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/session_model.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace foresight {

class PriorityRow;
class QuietLabel;

/// The strip along the top: which document is shown, what the head does, and the button that stops
/// it. Never covered, never wider than the window: what there is no room for goes, the button
/// stays.
class HeadStrip : public QFrame {
  Q_OBJECT

 public:
  HeadStrip(HeadViewModel* head, CommandTable* commands, QWidget* parent = nullptr);

  /// What the panes show: the live session, or `details` of a mission under review, all of a scan
  /// or a moment of its replay.
  void ShowDocument(SessionMode mode, const QString& details, bool replayed = false);

 private:
  void ShowStatus();
  void ShowMotion(const HeadStatus& status, const HeadAnswers& answers);

  HeadViewModel* head_;
  PriorityRow* row_;
  QLabel* mode_;
  QPushButton* back_;
  QLabel* state_;
  QLabel* angle_;
  QLabel* speed_;
  QLabel* lines_;
  QuietLabel* message_;
  QProgressBar* sweep_;
  QPushButton* release_;
};

}  // namespace foresight
