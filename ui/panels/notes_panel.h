#pragma once

#include <QWidget>

#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/measure_view_model.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace foresight {

/// Measurements and notes of a document: the list, where a click shows the place, name and tags of
/// the selected one, and the fields for a new note.
class NotesPanel : public QWidget {
  Q_OBJECT

 public:
  NotesPanel(SessionModel* session, MeasureViewModel* measure, CommandTable* commands,
             QWidget* parent = nullptr);

  QListWidget* List() { return list_; }
  /// Those of a new note.
  QLineEdit* Text() { return text_; }
  QLineEdit* Tags() { return tags_; }
  QComboBox* About() { return about_; }
  QPushButton* AddButton() { return add_; }

 private:
  enum class Subject { kScan, kObject, kMission };

  QWidget* BuildMeasureRow(CommandTable* commands);
  QWidget* BuildNewNote();
  void ShowList();
  void ShowEmpty();
  void ShowHint();
  void ShowSelected();
  void TakeNote();
  void TakeChange();
  QString WhyNoNote() const;

  SessionModel* session_;
  NotesModel* notes_;
  MeasureViewModel* measure_;
  QComboBox* kind_;
  QLabel* hint_;
  QLabel* empty_;
  QListWidget* list_;
  QLabel* details_;
  QLineEdit* selected_text_;
  QLineEdit* selected_tags_;
  QLineEdit* text_;
  QLineEdit* tags_;
  QComboBox* about_;
  QPushButton* add_;
  QLabel* problem_;
};

}  // namespace foresight
