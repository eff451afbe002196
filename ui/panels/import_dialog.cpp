#include "ui/panels/import_dialog.h"

#include <QComboBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QString NamesOf(const QStringList& files) {
  QStringList names;
  for (const QString& file : files) names << QFileInfo(file).fileName();
  constexpr int kMostNamed = 4;
  if (names.size() > kMostNamed)
    return ImportDialog::tr("%1 and %n more", nullptr, static_cast<int>(names.size()) - kMostNamed)
        .arg(names.mid(0, kMostNamed).join(QStringLiteral(", ")));
  return names.join(QStringLiteral(", "));
}

QWidget* MakeField(const ImportField& field, const QString& last) {
  QWidget* made = nullptr;
  if (field.values.isEmpty()) {
    auto* edit = new QLineEdit(last);
    edit->setPlaceholderText(field.tip);
    made = edit;
  } else {
    auto* choice = new QComboBox;
    for (const QString& value : field.values)
      choice->addItem(value.isEmpty() ? ImportDialog::tr("as the files say") : value, value);
    choice->setCurrentIndex(qMax(0, choice->findData(last)));
    made = choice;
  }
  made->setObjectName(QStringLiteral("import_") + field.key);
  made->setAccessibleName(field.title);
  made->setToolTip(field.tip);
  return made;
}

}  // namespace

ImportDialog::ImportDialog(const QStringList& files, const ImportChoices& last, QWidget* parent)
    : QDialog(parent), fault_(WordsLabel("importFault")), import_(new QPushButton(tr("Import"))) {
  setObjectName(QStringLiteral("import_dialog"));
  setWindowTitle(tr("Import"));
  setMinimumWidth(460);
  auto* names = WordsLabel("faint");
  names->setText(tr("Into a new mission: %1. What is left empty is taken from the files, or "
                    "assumed and said.")
                     .arg(NamesOf(files)));
  auto* form = new QFormLayout;
  for (const ImportField& field : ImportFieldsOf(ImportKindOf(files))) {
    QWidget* made = MakeField(field, last.value(field.key));
    fields_[field.key] = made;
    form->addRow(field.title, made);
  }
  fault_->setVisible(false);
  import_->setObjectName(QStringLiteral("importFiles"));
  import_->setDefault(true);
  auto* close = new QPushButton(tr("Close"));
  close->setAutoDefault(false);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  buttons->addWidget(import_);
  buttons->addWidget(close);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(20, 16, 20, 16);
  layout->setSpacing(10);
  layout->addWidget(names);
  layout->addLayout(form);
  layout->addWidget(fault_);
  layout->addLayout(buttons);
  connect(import_, &QPushButton::clicked, this, &ImportDialog::Take);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
}

ImportChoices ImportDialog::Choices() const {
  ImportChoices choices;
  for (auto field = fields_.begin(); field != fields_.end(); ++field) {
    const auto* choice = qobject_cast<QComboBox*>(field.value());
    const auto* edit = qobject_cast<QLineEdit*>(field.value());
    const QString text = choice != nullptr ? choice->currentData().toString() : edit->text();
    if (!text.trimmed().isEmpty()) choices[field.key()] = text.trimmed();
  }
  return choices;
}

void ImportDialog::Take() {
  const ImportChoices choices = Choices();
  const auto options = ImportOptionsFrom(choices);
  fault_->setVisible(!options);
  if (!options) {
    fault_->setText(QString::fromStdString(options.error().message));
    return;
  }
  Q_EMIT chosen(choices, *options);
  accept();
}

}  // namespace foresight
