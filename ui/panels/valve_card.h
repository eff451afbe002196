#pragma once

#include <QFrame>

#include "ui/viewmodels/session_model.h"

class QLabel;

namespace foresight {

/// Everything an operator needs to judge one found valve. Millimetres and degrees, in the robot's
/// frame.
class ValveCard : public QFrame {
  Q_OBJECT

 public:
  explicit ValveCard(QWidget* parent = nullptr);
  void Show(const FoundValve& valve, bool is_current);
  void ShowAge(const FoundValve& valve);

 private:
  QLabel* badge_icon_;
  QLabel* badge_text_;
  QFrame* badge_;
  QLabel* stale_;
  QLabel* reason_;
  QLabel* center_;
  QLabel* axis_;
  QLabel* diameter_;
  QLabel* spokes_;
  QLabel* support_;
  QLabel* source_;
  QLabel* age_;
};

}  // namespace foresight
