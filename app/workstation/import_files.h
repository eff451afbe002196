#pragma once

class QWidget;

namespace foresight {

class Workbench;

/// Asks for files of other programs, and imports them into a mission beside the recorded one, which
/// is then shown for review. Not modal.
void ChooseFilesToImport(QWidget* window, Workbench* bench);

}  // namespace foresight
