#pragma once

#include <QDialog>
#include <QMap>

#include "ui/viewmodels/import_choices.h"

class QLabel;
class QPushButton;

namespace foresight {

/// Asks how files are to be imported: the options of their kind, with what was chosen the last
/// time. A choice that cannot be is said below the fields, and keeps the dialogue open. Not modal.
class ImportDialog : public QDialog {
  Q_OBJECT

 public:
  ImportDialog(const QStringList& files, const ImportChoices& last, QWidget* parent = nullptr);

  ImportChoices Choices() const;
  /// The field of an option: a QLineEdit or a QComboBox; nullptr where the kind has none.
  QWidget* Field(const QString& key) const { return fields_.value(key); }
  QPushButton* ImportButton() { return import_; }
  QLabel* Fault() { return fault_; }

 Q_SIGNALS:
  void chosen(const ImportChoices& choices, const ImportOptions& options);

 private:
  void Take();

  QMap<QString, QWidget*> fields_;
  QLabel* fault_;
  QPushButton* import_;
};

}  // namespace foresight
