#pragma once

#include <QDialog>
#include <QStringList>

#include "app/workstation/connect_model.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace foresight {

/// Where the operator chooses a head: from the list of the local network, or by its address.
class ConnectDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param recent addresses, the last one first. @param keys folder of this station's keys, empty
  /// = the user's.
  ConnectDialog(ConnectModel* model, const QStringList& recent, const std::string& keys,
                QWidget* parent = nullptr);

 private:
  void Show();
  void ShowHeads();
  void TakeRow(int row);
  void Connect();
  LinkArguments Chosen() const;

  ConnectModel* model_;
  const std::string keys_;
  std::vector<AnnouncedHead> shown_;
  QLabel* search_;
  QListWidget* list_;
  QComboBox* address_;
  QCheckBox* thin_;
  QLabel* state_;
  QPushButton* connect_;
  QPushButton* close_;
};

}  // namespace foresight
