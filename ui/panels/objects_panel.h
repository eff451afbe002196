#pragma once

#include <QTimer>
#include <QWidget>

#include "ui/viewmodels/fit_view_model.h"

class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace foresight {

class DetectionCard;

/// What was found: a list, and a card for the chosen one.
class ObjectsPanel : public QWidget {
  Q_OBJECT

 public:
  ObjectsPanel(SessionModel* session, FitViewModel* fit, QWidget* parent = nullptr);

 private:
  QWidget* BuildFitRow();
  void ShowObjects();
  void ShowFit();
  void ShowAge();

  SessionModel* session_;
  FitViewModel* fit_;
  QComboBox* shape_;
  QComboBox* source_;
  QPushButton* fit_button_;
  QListWidget* list_;
  QLabel* empty_;
  DetectionCard* card_;
  QTimer age_timer_;
};

}  // namespace foresight
