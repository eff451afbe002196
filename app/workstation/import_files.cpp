#include "app/workstation/import_files.h"

#include <QFileDialog>
#include <QFileInfo>

#include "app/workstation/workbench.h"

namespace foresight {

void ChooseFilesToImport(QWidget* window, Workbench* bench) {
  auto* dialog = new QFileDialog(
      window, QFileDialog::tr("Import: a cloud or a bag, and its image, rig or calibration"), {},
      QFileDialog::tr("Files to import (*.ply *.pcd *.bin *.bag *.xyz *.txt *.csv *.3d *.png *.jpg "
                      "*.jpeg *.yaml *.yml);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("file_dialog"));
  dialog->setFileMode(QFileDialog::ExistingFiles);
  // A dialogue of the desktop's would keep the keys to itself, F12 among them.
  dialog->setOption(QFileDialog::DontUseNativeDialog);
  const QString folder = QFileInfo(bench->recording.Path()).absolutePath();
  dialog->setDirectory(folder);
  QObject::connect(
      dialog, &QFileDialog::filesSelected, bench,
      [bench, folder](const QStringList& files) { bench->importer.Import(files, folder); });
  dialog->setModal(false);  // a scan may be running: the stop button must stay within reach
  dialog->show();
}

}  // namespace foresight
