#pragma once

#include <QWidget>

#include "ui/viewmodels/mission_search_model.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;

namespace foresight {

/// A field for words, what they are looked for in, and what was found in all missions of a folder;
/// a click opens the mission for review.
class MissionSearchPanel : public QWidget {
  Q_OBJECT

 public:
  explicit MissionSearchPanel(MissionSearchModel* model, QWidget* parent = nullptr);

  QLineEdit* Words() { return words_; }
  QListWidget* Found() { return found_; }
  QString SummaryText() const;

 Q_SIGNALS:
  /// The operator wants to search another folder.
  void folderWanted();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void ShowFound();
  void ShowFolder();

  MissionSearchModel* model_;
  QLineEdit* words_;
  QComboBox* what_;
  QLabel* folder_;
  QLabel* summary_;
  QListWidget* found_;
  bool stale_ = true;
};

}  // namespace foresight
