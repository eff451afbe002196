#pragma once

#include <QWidget>

#include "ui/viewmodels/link_view_model.h"

class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace foresight {

class QuietLabel;

/// The link to a head that is elsewhere: how it does, who has control, and the scans at the head
/// in the order in which they come, which the operator can change.
class LinkPanel : public QWidget {
  Q_OBJECT

 public:
  explicit LinkPanel(LinkViewModel* link, QWidget* parent = nullptr);

 private:
  QWidget* BuildFigures();
  QWidget* BuildControl();
  QWidget* BuildScans();
  void Show();
  void ShowScans();
  void ShowButtons();
  QString Chosen() const;

  LinkViewModel* link_;
  QLabel* state_;
  QuietLabel* last_word_;
  QuietLabel* round_trip_;
  QuietLabel* rate_;
  QuietLabel* left_;
  QLabel* trouble_;
  QLabel* control_;
  QPushButton* take_;
  QPushButton* give_;
  QLineEdit* successor_;
  QListWidget* list_;
  QPushButton* first_;
  QPushButton* pause_;
  QVector<LinkedScanRow> shown_;
};

}  // namespace foresight
