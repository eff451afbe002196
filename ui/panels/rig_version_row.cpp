#include "ui/panels/rig_version_row.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

#include "ui/widgets/dock_parts.h"

namespace foresight {

RigVersionRow::RigVersionRow(RigVersionModel* rig, Source source, QWidget* parent)
    : QWidget(parent),
      rig_(rig),
      source_(std::move(source)),
      save_(NarrowButton("saveRig", tr("Save rig..."))),
      force_(NarrowButton("putInForce", tr("Put in force"))),
      back_(NarrowButton("rollBack", tr("Roll back"))),
      saved_(WordsLabel("faint")) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(6);
  grid->addWidget(save_, 0, 0);
  grid->addWidget(force_, 0, 1);
  grid->addWidget(back_, 1, 0, 1, 2);
  grid->addWidget(saved_, 2, 0, 1, 2);
  connect(save_, &QPushButton::clicked, this, &RigVersionRow::ChooseFile);
  connect(force_, &QPushButton::clicked, rig_, &RigVersionModel::putInForce);
  connect(back_, &QPushButton::clicked, rig_, &RigVersionModel::rollBack);
}

void RigVersionRow::Refresh() {
  ShowPossible(save_, source_.what, source_.why_not_save());
  ShowPossible(force_, tr("Give the saved rig to the head, read it back and compare"),
               rig_->WhyNotPutInForce());
  ShowPossible(back_, tr("Give the head the rig that it had before"), rig_->WhyNotRollBack());
  const QString file = rig_->SavedFile();
  saved_->setText(file.isEmpty() ? QString() : tr("Saved: %1").arg(file));
  saved_->setVisible(!file.isEmpty());
}

void RigVersionRow::ChooseFile() {
  auto* dialog = new QFileDialog(this, tr("Save as a new rig"), {}, tr("Rigs (*.yaml)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("file_dialog"));
  dialog->setOption(QFileDialog::DontUseNativeDialog);
  dialog->setOption(QFileDialog::DontConfirmOverwrite);  // an existing file is refused
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("yaml"));
  const QFileInfo suggested(source_.suggested_file());
  dialog->setDirectory(suggested.path());
  dialog->selectFile(suggested.fileName());
  connect(dialog, &QFileDialog::fileSelected, this, source_.save);
  dialog->setModal(false);
  dialog->show();
}

}  // namespace foresight
