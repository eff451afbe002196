#pragma once

namespace foresight {

class Workbench;

/// The rows of the command table that need no window. The main window adds those that do.
void AddCommands(Workbench* bench);

}  // namespace foresight
