# One object library a folder. `foresight_module(NAME SOURCES ... LINK ...)` compiles our code with our
# warnings; includes are written from the project's root: #include "core/depth/pipeline.h".
function(foresight_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} OBJECT ${arg_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${arg_LINK} PRIVATE foresight_warnings)
endfunction()
