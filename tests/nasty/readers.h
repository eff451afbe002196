#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace foresight::nasty {

/// One way by which a file gets into a program.
struct Reader {
  std::string name;
  std::string file_name;  ///< that the programs know it by, with its extension
  bool text = false;
  std::string good;                   ///< a file that is read
  std::vector<std::string> handmade;  ///< files that somebody thought of
  bool head = false;                  ///< foresight-head reads it, not foresightctl
  /// The program's arguments for the file at this path; results go into this folder.
  std::function<std::vector<std::string>(const std::string& path, const std::string& out)> command;
};

/// All readers, with the good files that they need beside the nasty one in `folder`. `ctl` makes
/// what only a program can make. Fails where that does not work.
Result<std::vector<Reader>> AllReaders(const std::string& folder, const std::string& ctl);

}  // namespace foresight::nasty
