#include "app/workstation/import_files.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>

#include "app/workstation/file_choice.h"
#include "app/workstation/workbench.h"
#include "ui/panels/import_dialog.h"

namespace foresight {

namespace {

QString SettingOf(const QStringList& files) {
  return QStringLiteral("import/") + KeyOf(ImportKindOf(files));
}

ImportChoices LastChoices(const QStringList& files) {
  ImportChoices choices;
  const QVariantMap kept = QSettings().value(SettingOf(files)).toMap();
  for (auto entry = kept.begin(); entry != kept.end(); ++entry)
    choices[entry.key()] = entry.value().toString();
  return choices;
}

void KeepChoices(const QStringList& files, const ImportChoices& choices) {
  QVariantMap kept;
  for (auto entry = choices.begin(); entry != choices.end(); ++entry)
    kept[entry.key()] = entry.value();
  QSettings().setValue(SettingOf(files), kept);
}

}  // namespace

void AskHowToImport(QWidget* window, Workbench* bench, const QStringList& files,
                    const QString& folder) {
  auto* dialog = new ImportDialog(files, LastChoices(files), window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(
      dialog, &ImportDialog::chosen, bench,
      [bench, files, folder](const ImportChoices& choices, const ImportOptions& options) {
        KeepChoices(files, choices);
        bench->importer.Import(files, folder, options);
      });
  dialog->setModal(false);  // a scan may be running: the stop button must stay within reach
  dialog->show();
}

void ChooseFilesToImport(const FileChoice* files, QWidget* window, Workbench* bench) {
  const QString folder = QFileInfo(bench->recording.Path()).absolutePath();
  files->ManyToOpen(
      QFileDialog::tr("Import: a cloud or a bag, and its image, rig or calibration"),
      QFileDialog::tr("Files to import (*.ply *.pcd *.bin *.bag *.xyz *.txt *.csv *.3d *.png *.jpg "
                      "*.jpeg *.yaml *.yml);;All files (*)"),
      [window, bench, folder](const QStringList& chosen) {
        AskHowToImport(window, bench, chosen, folder);
      });
}

}  // namespace foresight
