#pragma once

#include <QWidget>

#include "ui/viewmodels/options_model.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace foresight {

/// The field in which one option is set. What is typed stays as it is typed; what is wrong with it
/// is said under the field.
class OptionField : public QWidget {
  Q_OBJECT

 public:
  OptionField(OptionsModel* model, const OptionRow& row, QWidget* parent = nullptr);

  const std::string& Key() const { return row_.info.key; }
  /// Another value of the same option.
  void Show(const OptionRow& row);
  /// What is wrong with what was typed; empty = nothing.
  QString Fault() const;
  QLineEdit* Edit() const { return edit_; }
  QComboBox* Choice() const { return choice_; }
  QCheckBox* Switch() const { return switch_; }

 protected:
 private:
  QWidget* Build();
  QWidget* BuildDocument();
  void Take(const Result<OptionValue>& value);
  void TakeText();
  void ChooseDocument();

  OptionsModel* model_;
  OptionRow row_;
  QLineEdit* edit_ = nullptr;
  QComboBox* choice_ = nullptr;
  QCheckBox* switch_ = nullptr;
  QPushButton* document_ = nullptr;
  QLabel* fault_;
};

}  // namespace foresight
