#pragma once

#include <QWidget>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/replay_model.h"

class QLabel;
class QStackedWidget;
class QToolButton;

namespace foresight {

class QuietLabel;
class TimelineView;

/// The dock of the review's time: what happened when, and the controls of the replay.
class TimelinePanel : public QWidget {
  Q_OBJECT

 public:
  TimelinePanel(TimelineModel* timeline, ReplayModel* replay, ReviewViewModel* review,
                CommandTable* commands, QWidget* parent = nullptr);

  TimelineView* View() { return view_; }
  /// "16:04:12.3, replay 4×, scan 2 of 3".
  QString MomentText() const;

 private:
  QToolButton* Button(const char* icon, const char* command);
  void GoTo(const TimelineEntry& entry);
  void ShowMoment();

  TimelineModel* timeline_;
  ReplayModel* replay_;
  ReviewViewModel* review_;
  CommandTable* commands_;
  QStackedWidget* pages_;
  TimelineView* view_;
  QToolButton* play_;
  QLabel* speed_;
  QuietLabel* moment_;
};

}  // namespace foresight
