#pragma once

#include <QWidget>

#include "ui/viewmodels/mission_view_model.h"

class QLabel;
class QListWidget;

namespace foresight {

/// Which mission file is shown or written, and its scans to choose from.
class MissionPanel : public QWidget {
  Q_OBJECT

 public:
  explicit MissionPanel(MissionViewModel* mission, QWidget* parent = nullptr);

 private:
  void ShowMission();

  MissionViewModel* mission_;
  QLabel* path_;
  QListWidget* scans_;
};

}  // namespace foresight
