#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace foresight {

/// Where a program's log is kept: `$XDG_STATE_HOME/foresight/PROGRAM.log`, else
/// `~/.local/state/foresight/PROGRAM.log`. Empty where neither is known.
std::filesystem::path LogFileOf(const std::string& program);

/// From now on every line of the log also goes to the file, with its date; the folder is made. At
/// 1 MB it becomes `PROGRAM.1.log`, and so on; three are kept. Fails with kIo.
Status KeepLogFile(const std::filesystem::path& file);

}  // namespace foresight
