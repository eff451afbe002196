# One object library a folder. `foresight_module(NAME SOURCES ... LINK ...)` compiles our code with our
# warnings; includes are written from the project's root: #include "core/depth/pipeline.h".
# PRECOMPILED: another kind than common (ForesightPrecompiled.cmake).
function(foresight_module name)
  cmake_parse_arguments(arg "" "PRECOMPILED" "SOURCES;LINK" ${ARGN})
  if(NOT arg_PRECOMPILED)
    set(arg_PRECOMPILED common)
  endif()
  add_library(${name} OBJECT ${arg_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${arg_LINK} PRIVATE foresight_warnings)
  foresight_precompiled(${name} ${arg_PRECOMPILED})
endfunction()

# A shared library that uses nothing but what it links. A sanitizer's or a fuzzer's own symbols come from
# the program.
function(foresight_closed name)
  if(NOT FORESIGHT_SANITIZE AND NOT FORESIGHT_FUZZ)
    target_link_options(${name} PRIVATE LINKER:--no-undefined)
  endif()
endfunction()
