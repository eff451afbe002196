#pragma once

#include <QString>
#include <functional>

namespace foresight {

class Workbench;

/// The rows of the command table that measure and write down.
void AddMeasureCommands(Workbench* bench);

/// Asks for a file, and tells which was chosen.
using AskForFile = std::function<void(const QString& title, const QString& filter,
                                      const std::function<void(QString)>& chosen)>;

/// Those of them that ask for a file.
void AddMapFileCommands(Workbench* bench, const AskForFile& ask);

}  // namespace foresight
