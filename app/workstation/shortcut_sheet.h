#pragma once

#include "ui/viewmodels/command_table.h"

class QWidget;

namespace foresight {

/// Opens a window with the keys of these actions. It does not block the one below.
void ShowShortcutSheet(const CommandTable& commands, QWidget* parent);

}  // namespace foresight
