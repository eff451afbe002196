#pragma once

#include "ui/viewmodels/command_table.h"

class QAbstractButton;

namespace foresight {

/// Makes a button run a command: enabled while the command is allowed, with the command's key and,
/// while it is not allowed, the reason in its tooltip. The text stays the button's own.
void BindButton(QAbstractButton* button, CommandTable* commands, const char* id);

/// "Start the planned scan (Space)", and the reason below where it is not allowed.
QString ToolTipOf(const Command& command);

}  // namespace foresight
