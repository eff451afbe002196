#pragma once

namespace foresight {

/// The programs' version, "1.2.3": the project's, as CMakeLists.txt names it.
const char* ProgramVersion();

}  // namespace foresight
