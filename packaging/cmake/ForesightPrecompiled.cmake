# Precompiled headers: Eigen, fmt, Qt, CLI11, gRPC and GoogleTest are parsed once and not once a file, which
# halves a build from nothing. `foresight_precompiled(TARGET KIND)`: KIND is a header of
# packaging/cmake/precompiled. All targets of one kind share one.
option(FORESIGHT_PRECOMPILED "Parse common headers once" ON)
if(FORESIGHT_FUZZ)
  set(FORESIGHT_PRECOMPILED OFF)  # a few files only, by another compiler
endif()

# Three quarters of the time that a command or a test took to compile went into making it fast, and
# nothing in it needs to be: what takes time is in the libraries.
function(foresight_compile_quickly target kind)
  if(kind STREQUAL command_line OR kind MATCHES test)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# Files of one library or test program share much of what their templates make, so twenty of them are compiled as one. Two files of one
# batch cannot have the same name in their unnamed namespaces: one of them gets another name, or SKIP_UNITY_BUILD_INCLUSION.
option(FORESIGHT_UNITY "Compile files in batches (who changes them often wants OFF)" ON)

function(foresight_precompiled target kind)
  foresight_compile_quickly(${target} ${kind})
  if(FORESIGHT_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
  endif()
  if(NOT FORESIGHT_PRECOMPILED)
    return()
  endif()
  set(owner foresight_precompiled_${kind})
  if(NOT TARGET ${owner})
    set(source ${PROJECT_BINARY_DIR}/precompiled/${kind}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "// Carries the precompiled header of its kind.\n")
    add_library(${owner} OBJECT ${source})
    target_include_directories(${owner} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${owner} PRIVATE fmt::fmt tl::expected Eigen3::Eigen foresight_warnings)
    if(kind MATCHES window OR kind STREQUAL view_model)
      target_link_libraries(${owner} PRIVATE Qt::$<IF:$<STREQUAL:${kind},view_model>,Core,Widgets>)
      target_compile_definitions(${owner} PRIVATE QT_NO_KEYWORDS)
      if(kind STREQUAL window_test)
        target_link_libraries(${owner} PRIVATE GTest::gtest)
      endif()
    elseif(kind STREQUAL command_line)
      target_link_libraries(${owner} PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json)
    elseif(kind MATCHES test)
      target_link_libraries(${owner} PRIVATE GTest::gmock GTest::gtest)
    endif()
    if(kind MATCHES link)
      target_include_directories(${owner} SYSTEM PRIVATE ${PROJECT_BINARY_DIR}/hardware/link/made)
      target_link_libraries(${owner} PRIVATE protobuf::libprotobuf PkgConfig::grpc)
      add_dependencies(${owner} foresight_link_made)
    endif()
    foresight_compile_quickly(${owner} ${kind})
    target_precompile_headers(${owner} PRIVATE
      ${PROJECT_SOURCE_DIR}/packaging/cmake/precompiled/${kind}.h)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # else ccache gives up
  endif()
endfunction()
