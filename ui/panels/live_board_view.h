#pragma once

#include <QWidget>

#include "ui/viewmodels/live_board_model.h"

class QLabel;
class QPushButton;

namespace foresight {

/// What the head's camera sees now, with the corners of the boards in it.
class LiveBoardView : public QWidget {
  Q_OBJECT

 public:
  explicit LiveBoardView(LiveBoardModel* model, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;  ///< nobody looks: the camera need not work

 private:
  class Picture;

  void Refresh();

  LiveBoardModel* model_;
  QPushButton* toggle_;
  Picture* picture_;
  QLabel* text_;
};

}  // namespace foresight
