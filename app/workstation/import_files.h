#pragma once

#include <QStringList>

class QWidget;

namespace foresight {

class FileChoice;
class Workbench;

/// Asks for files of other programs, and imports them into a mission beside the recorded one, which
/// is then shown for review. Not modal. How they are imported is asked behind that.
void ChooseFilesToImport(const FileChoice* files, QWidget* window, Workbench* bench);

/// Asks how these files are imported into a new mission in `folder`, with what was chosen the last
/// time for files of their kind. Not modal.
void AskHowToImport(QWidget* window, Workbench* bench, const QStringList& files,
                    const QString& folder);

}  // namespace foresight
