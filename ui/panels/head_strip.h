#pragma once

#include <QFrame>

#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/session_model.h"

class QLabel;
class QProgressBar;

namespace foresight {

/// The strip along the top: where the data come from, what the head does, and the button that stops
/// it. Never covered.
class HeadStrip : public QFrame {
  Q_OBJECT

 public:
  HeadStrip(HeadViewModel* head, SessionModel* session, QWidget* parent = nullptr);

 private:
  void ShowMode();
  void ShowStatus();

  HeadViewModel* head_;
  SessionModel* session_;
  QLabel* mode_;
  QLabel* state_;
  QLabel* angle_;
  QLabel* speed_;
  QLabel* lines_;
  QLabel* message_;
  QProgressBar* sweep_;
};

}  // namespace foresight
