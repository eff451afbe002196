# foresight_embed(VARIABLE FUNCTION files ...): writes a source file that defines
# `std::span<const foresight::EmbeddedFile> foresight::FUNCTION()` with the files' texts, and puts its
# path into VARIABLE. Changed files are taken over by the next build.
function(foresight_embed variable function)
  set(entries "")
  foreach(file ${ARGN})
    file(READ ${file} text)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${file})
    string(APPEND entries "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT [[
#include <vector>

#include "core/base/embedded_files.h"

namespace foresight {

std::span<const EmbeddedFile> @function@();

std::span<const EmbeddedFile> @function@() {
  static const std::vector<EmbeddedFile> files = {
@entries@  };
  return files;
}

}  // namespace foresight
]] @ONLY)
  set(${variable} ${source} PARENT_SCOPE)
endfunction()
