#pragma once

#include <QFrame>

#include "ui/viewmodels/session_model.h"

class QFormLayout;
class QLabel;
class QToolButton;

namespace foresight {

/// Everything an operator needs to judge one found object: verdict, reason, what to do, and the
/// candidate's pose in the robot's frame. Millimetres and degrees.
class DetectionCard : public QFrame {
  Q_OBJECT

 public:
  explicit DetectionCard(QWidget* parent = nullptr);
  void Show(const FoundObject& object, int candidate, bool is_current);
  void ShowAge(const FoundObject& object);

 Q_SIGNALS:
  void nextAsked();
  void previousAsked();

 private:
  QWidget* BuildBadge();
  QWidget* BuildSteps();
  void AddRow(const QString& name, const QString& value);
  void ShowVerdict(const Verdict& verdict, VerdictLevel candidate_level);

  QFrame* badge_;
  QLabel* badge_icon_;
  QLabel* badge_text_;
  QLabel* stale_;
  QLabel* reason_;
  QLabel* advice_;
  QWidget* steps_;
  QLabel* answer_;
  QFormLayout* facts_;
  QLabel* age_ = nullptr;
};

}  // namespace foresight
