#pragma once

#include <QTimer>
#include <QWidget>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/fit_view_model.h"

class QComboBox;
class QLabel;
class QListWidget;
class QListWidgetItem;
class QPushButton;

namespace foresight {

class DetectionCard;

/// What was found in one document: a list, a card for the chosen object, and what the operator
/// decides on it.
class ObjectsPanel : public QWidget {
  Q_OBJECT

 public:
  ObjectsPanel(SessionModel* session, FitViewModel* fit, CommandTable* commands,
               QWidget* parent = nullptr);

 private:
  QWidget* BuildFitRow(CommandTable* commands);
  QWidget* BuildDecisions(CommandTable* commands);
  void ShowObjects();
  void ShowEmpty();
  void ShowFit();
  void ShowAge();
  void TakeName(const QListWidgetItem* item);

  SessionModel* session_;
  FitViewModel* fit_;
  QComboBox* shape_;
  QComboBox* source_;
  QPushButton* fit_button_;
  QListWidget* list_;
  QLabel* empty_;
  QWidget* decisions_;
  DetectionCard* card_;
  QTimer age_timer_;
};

}  // namespace foresight
