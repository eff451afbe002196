#include "app/workstation/file_choice.h"

#include <QFileDialog>
#include <utility>

namespace foresight {

FileChoice::FileChoice(QWidget* window, std::function<QString()> folder)
    : window_(window), folder_(std::move(folder)) {}

QFileDialog* FileChoice::Dialog(const QString& title, const QString& filter) const {
  auto* dialog = new QFileDialog(window_, title, {}, filter);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("file_dialog"));
  // A dialogue of the desktop's would keep the keys to itself, F12 among them.
  dialog->setOption(QFileDialog::DontUseNativeDialog);
  dialog->setDirectory(folder_());
  dialog->setModal(false);
  return dialog;
}

void FileChoice::Ask(QFileDialog* dialog, const Chosen& chosen) const {
  QObject::connect(dialog, &QFileDialog::fileSelected, window_, chosen);
  dialog->show();
}

void FileChoice::ToOpen(const QString& title, const QString& filter, const Chosen& chosen) const {
  QFileDialog* dialog = Dialog(title, filter);
  dialog->setFileMode(QFileDialog::ExistingFile);
  Ask(dialog, chosen);
}

void FileChoice::ManyToOpen(const QString& title, const QString& filter,
                            const std::function<void(const QStringList&)>& chosen) const {
  QFileDialog* dialog = Dialog(title, filter);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  QObject::connect(dialog, &QFileDialog::filesSelected, window_, chosen);
  dialog->show();
}

void FileChoice::ToSave(const QString& title, const QString& filter, const QString& suffix,
                        const Chosen& chosen) const {
  QFileDialog* dialog = Dialog(title, filter);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setFileMode(QFileDialog::AnyFile);
  dialog->setDefaultSuffix(suffix);
  Ask(dialog, chosen);
}

void FileChoice::Folder(const QString& title, const Chosen& chosen) const {
  QFileDialog* dialog = Dialog(title, {});
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  Ask(dialog, chosen);
}

}  // namespace foresight
