#include "ui/panels/option_field.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "core/base/atomic_file.h"
#include "core/options/option_text.h"

namespace foresight {
namespace {

QString Text(const std::string& text) {
  return QString::fromStdString(text);
}

/// 0 stands for a rule where the option has one.
bool IsAutomatic(const OptionRow& row) {
  const auto* number = std::get_if<double>(&row.value);
  return !row.info.automatic.empty() && number != nullptr && *number == 0.0;
}

}  // namespace

OptionField::OptionField(OptionsModel* model, const OptionRow& row, QWidget* parent)
    : QWidget(parent), model_(model), row_(row), fault_(new QLabel) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(Build());
  layout->addWidget(fault_);
  fault_->setWordWrap(true);
  fault_->setObjectName(QStringLiteral("fault"));
  fault_->hide();
  Show(row);
}

QWidget* OptionField::Build() {
  const QString title = OptionsModel::tr(row_.info.title.c_str());
  switch (row_.info.type) {
    case OptionType::kSwitch:
      switch_ = new QCheckBox;
      switch_->setAccessibleName(title);
      connect(switch_, &QCheckBox::clicked, this, [this](bool on) { Take(OptionValue(on)); });
      return switch_;
    case OptionType::kChoice:
      choice_ = new QComboBox;
      choice_->setAccessibleName(title);
      for (const std::string& word : row_.info.words)
        choice_->addItem(OptionsModel::tr(word.c_str()), Text(word));
      connect(choice_, QOverload<int>::of(&QComboBox::activated), this, [this](int index) {
        Take(OptionValue(choice_->itemData(index).toString().toStdString()));
      });
      return choice_;
    case OptionType::kDocument:
      return BuildDocument();
    case OptionType::kNumber:
    case OptionType::kInteger:
    case OptionType::kSeed:
    case OptionType::kNumbers:
      break;
  }
  edit_ = new QLineEdit;
  edit_->setAccessibleName(title);
  edit_->setPlaceholderText(OptionsModel::tr(row_.info.automatic.c_str()));
  connect(edit_, &QLineEdit::editingFinished, this, &OptionField::TakeText);
  auto* line = new QWidget;
  auto* layout = new QHBoxLayout(line);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(edit_, 1);
  if (!row_.info.unit.empty()) layout->addWidget(new QLabel(Text(row_.info.unit)));
  return line;
}

QWidget* OptionField::BuildDocument() {
  document_ = new QPushButton;
  document_->setAccessibleName(OptionsModel::tr(row_.info.title.c_str()));
  connect(document_, &QPushButton::clicked, this, [this] {
    if (std::get<std::string>(row_.value) == std::get<std::string>(row_.usual))
      ChooseDocument();
    else
      Take(row_.usual);
  });
  return document_;
}

void OptionField::ChooseDocument() {
  auto* dialog = new QFileDialog(this, OptionsModel::tr(row_.info.title.c_str()));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setOption(QFileDialog::DontUseNativeDialog);  // it would keep F12 to itself
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setModal(false);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
    const auto text = ReadFile(path.toStdString());
    Take(text ? Result<OptionValue>(OptionValue(*text)) : tl::unexpected(text.error()));
  });
  dialog->show();
}

void OptionField::Show(const OptionRow& row) {
  row_ = row;
  if (switch_ != nullptr) switch_->setChecked(std::get<bool>(row.value));
  if (choice_ != nullptr)
    choice_->setCurrentIndex(choice_->findData(Text(std::get<std::string>(row.value))));
  if (document_ != nullptr)
    document_->setText(row.Changed() ? tr("A file's; take the usual one again")
                                     : tr("Choose a file"));
  // What is being typed is not touched.
  if (edit_ != nullptr && !edit_->hasFocus() && Fault().isEmpty())
    edit_->setText(IsAutomatic(row) ? QString() : Text(OptionText(row.info, row.value)));
}

QString OptionField::Fault() const {
  return fault_->isHidden() ? QString() : fault_->text();
}

void OptionField::TakeText() {
  const QString typed = edit_->text().trimmed();
  if (typed == Text(OptionText(row_.info, row_.value)) || (typed.isEmpty() && IsAutomatic(row_))) {
    fault_->hide();
    return;
  }
  const bool automatic = typed.isEmpty() && !row_.info.automatic.empty();
  Take(automatic ? Result<OptionValue>(OptionValue(0.0))
                 : OptionFromText(row_.info, typed.toStdString()));
}

void OptionField::Take(const Result<OptionValue>& value) {
  const Status taken =
      value.and_then([this](const OptionValue& wanted) { return model_->Set(Key(), wanted); });
  fault_->setVisible(!taken.has_value());
  if (!taken) fault_->setText(Text(taken.error().message));
}

}  // namespace foresight
