# Read by ctest, which knows nothing of CMake's targets: the tests of one program, each suite of GoogleTest's one test of ctest's, "core_io.Png".
# A process for each of 2900 tests took longer than most of the tests (0.08 s of CPU), and the tests of a suite share what is costly.
# foresight_tests writes the file that sets these and includes this one:
#   program, name, list (a file that keeps what the program lists), filter (of GoogleTest's), label, timeout, cost
if(NOT EXISTS "${program}")
  add_test("${name}.IsNotBuilt" "${program}")
  return()
endif()
if(NOT EXISTS "${list}" OR NOT "${list}" IS_NEWER_THAN "${program}")
  execute_process(COMMAND "${program}" --gtest_list_tests "--gtest_filter=${filter}" OUTPUT_FILE "${list}" RESULT_VARIABLE failed TIMEOUT 60)
  if(failed)
    file(REMOVE "${list}")
    message(FATAL_ERROR "${program} does not list its tests: ${failed}")
  endif()
endif()
file(STRINGS "${list}" lines)

macro(foresight_add_suite)
  if(tests)
    list(JOIN tests ":" names)
    add_test("${name}.${suite}" "${program}" "--gtest_filter=${names}")
    # Skipped is a suite all of whose tests were skipped, and nothing else.
    set_tests_properties("${name}.${suite}" PROPERTIES LABELS "${label}" TIMEOUT "${timeout}" COST "${cost}"
      SKIP_REGULAR_EXPRESSION "\\[  PASSED  \\] 0 tests\\.\n\\[  SKIPPED \\] [0-9]+ tests?, listed below:\n(\\[  SKIPPED \\] [^\n]*\n)*$")
  endif()
  set(tests)
endmacro()
set(tests)
foreach(line IN LISTS lines)
  string(REGEX REPLACE " *#.*$" "" line "${line}")  # a parameter's value
  if(line MATCHES "^([^ ]+)\\.$")
    set(next "${CMAKE_MATCH_1}")
    foresight_add_suite()
    set(suite "${next}")
  elseif(line MATCHES "^  ([^ ]+)$")
    list(APPEND tests "${suite}.${CMAKE_MATCH_1}")
  endif()
endforeach()
foresight_add_suite()
