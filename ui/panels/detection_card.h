#pragma once

#include <QFrame>
#include <QVector>
#include <utility>

#include "ui/viewmodels/session_model.h"

class QFormLayout;
class QLabel;
class QToolButton;

namespace foresight {

class QuietLabel;

/// Everything an operator needs to judge one found object: verdict, reason, what to do, and the
/// candidate's pose in the robot's frame. Millimetres and degrees. All of it is about the answer
/// that is drawn.
class DetectionCard : public QFrame {
  Q_OBJECT

 public:
  explicit DetectionCard(QWidget* parent = nullptr);
  void Show(const FoundObject& object, int candidate, bool is_current, SessionMode mode);
  void ShowAge(const FoundObject& object);
  /// What stands in the badge.
  QString Badge() const;

 Q_SIGNALS:
  void nextAsked();
  void previousAsked();

 private:
  QWidget* BuildBadge();
  QWidget* BuildSteps();
  void ShowRows(const QVector<std::pair<QString, QString>>& rows);

  QFrame* badge_;
  QLabel* badge_icon_;
  QLabel* badge_text_;
  QLabel* stale_;
  QLabel* reason_;
  QLabel* advice_;
  QWidget* steps_;
  QLabel* answer_;
  QFormLayout* facts_;
  /// Title and value; kept from one answer to the next, so that nothing flickers.
  QVector<std::pair<QLabel*, QLabel*>> rows_;
  QuietLabel* age_;
};

}  // namespace foresight
