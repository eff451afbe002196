#pragma once

namespace foresight {

class Workbench;

/// The rows of the command table that measure and write down.
void AddMeasureCommands(Workbench* bench);

}  // namespace foresight
