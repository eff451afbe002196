#pragma once

#include <QVector>
#include <QWidget>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/side_results_model.h"

class QLabel;
class QLineEdit;
class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace foresight {

/// The side results of the scan under review, a card each: name, author, time and what differs in
/// words, with the buttons A and B; and what the two that are chosen differ in.
class SideResultsPanel : public QWidget {
  Q_OBJECT

 public:
  SideResultsPanel(SideResultsModel* model, CommandTable* commands, QWidget* parent = nullptr);

  /// The name for the next run; empty = one is made up.
  QString Name() const;
  QLineEdit* NameField() { return name_; }
  /// Of a row of the model.
  QToolButton* ButtonA(int index) const { return a_.value(index); }
  QToolButton* ButtonB(int index) const { return b_.value(index); }
  /// Its menu renames and deletes; nullptr for an original.
  QToolButton* MoreButton(int index) const { return more_.value(index); }

 private:
  void ShowRows();
  QWidget* Card(int index);
  QToolButton* BuildMore(int index, QLabel* title, QVBoxLayout* card);

  SideResultsModel* model_;
  QLineEdit* name_;
  QLabel* state_;
  QVBoxLayout* cards_;
  QWidget* list_ = nullptr;
  QLabel* numbers_;
  QVector<QToolButton*> a_;
  QVector<QToolButton*> b_;
  QVector<QToolButton*> more_;
};

}  // namespace foresight
