# Language level, warnings, sanitizers, ccache and mold. Warnings are errors for our own code only.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# The same for programs and libraries, so that they can share precompiled headers.
add_compile_options(-fPIC)
# gcc looks for memory to give back when it has twice what it had; when it has a few gigabytes is soon enough, and a tenth faster. Where two
# compilers of that size find no room it stays careful.
cmake_host_system_information(RESULT FORESIGHT_MEMORY_MB QUERY TOTAL_PHYSICAL_MEMORY)
if(FORESIGHT_MEMORY_MB GREATER 12000)
  add_compile_options("$<$<COMPILE_LANG_AND_ID:CXX,GNU>:SHELL:--param ggc-min-expand=1000 --param ggc-min-heapsize=2000000>")
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

find_program(FORESIGHT_CCACHE ccache)
if(FORESIGHT_CCACHE)
  # ccache keeps files that use a precompiled header only when it is told that their macros and times
  # do not matter.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${FORESIGHT_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()
find_program(FORESIGHT_MOLD mold)
if(FORESIGHT_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# Eigen must not guess a larger malloc alignment than the one PCL was built with: with a sanitizer or
# AVX it otherwise frees with another allocator than PCL allocated with.
add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)

if(FORESIGHT_SANITIZE)
  add_compile_options(-fsanitize=${FORESIGHT_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FORESIGHT_SANITIZE})
  if(FORESIGHT_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()

add_library(foresight_warnings INTERFACE)
# clang, which compiles the fuzzers, warns of other things than gcc and may; gcc decides.
target_compile_options(foresight_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wconversion
  -Wno-sign-conversion -Werror
  # gcc 12 reports these from inlined Eigen code at -O2, in headers that are SYSTEM.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-error=array-bounds -Wno-error=maybe-uninitialized
  -Wno-error=stringop-overflow -Wno-error=stringop-overread -Wno-error=free-nonheap-object>
  $<$<CXX_COMPILER_ID:Clang>:-w>)
