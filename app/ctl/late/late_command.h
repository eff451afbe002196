#pragma once

#include <CLI/CLI.hpp>

#include "app/ctl/command.h"

namespace foresight {

// Four commands need VTK's writers, ROS's bags or PCL's registration. To load these takes longer
// than all the rest of a start, so the options and the work of the four are in a library of their
// own, libforesightctl_late, which is loaded when one of them is called.

/// What the library has for each: adds the options to `command`, and fills `invocation` when they
/// are parsed.
using AddLateOptions = void(CLI::App* command, Invocation* invocation);
extern "C" {
AddLateOptions AddMapOptions;
AddLateOptions AddBundleOptions;
AddLateOptions AddMissionImportOptions;
AddLateOptions AddMissionExportOptions;
}

}  // namespace foresight
