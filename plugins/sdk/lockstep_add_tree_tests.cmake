# lockstep_add_tree_tests(FILE|FOLDER… [OPTIONS option…]) makes a test of CTest of each scenario: its
# name is that of the file and the scenario. OPTIONS are those of `lockstep test`, as
# --plugin-path ${CMAKE_BINARY_DIR}. The program is LOCKSTEP_PROGRAM, which find_package(lockstep) finds.
# Scenarios are listed when the project is configured, which happens again when one of their
# files changes. docs/testing.md
function(lockstep_add_tree_tests)
  cmake_parse_arguments(TESTS "" "" "OPTIONS" ${ARGN})
  if(NOT LOCKSTEP_PROGRAM)
    message(FATAL_ERROR "lockstep_add_tree_tests: there is no program lockstep; set LOCKSTEP_PROGRAM")
  endif()
  execute_process(
    COMMAND ${LOCKSTEP_PROGRAM} test --list ${TESTS_UNPARSED_ARGUMENTS}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    RESULT_VARIABLE result OUTPUT_VARIABLE list ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "lockstep_add_tree_tests: ${LOCKSTEP_PROGRAM} test --list says\n${error}")
  endif()
  # A line is FILE:LINE:COLUMN: NAME. What CMake reads as a list is none.
  string(REPLACE ";" "\\;" list "${list}")
  string(REPLACE "[" "<lockstep-open>" list "${list}")
  string(REPLACE "]" "<lockstep-close>" list "${list}")
  string(REPLACE "\n" ";" list "${list}")
  foreach(line IN LISTS list)
    if(NOT line MATCHES "^(.*):[0-9]+:[0-9]+: (.*)$")
      continue()
    endif()
    set(file "${CMAKE_MATCH_1}")
    set(scenario "${CMAKE_MATCH_2}")
    foreach(text file scenario)
      string(REPLACE "<lockstep-open>" "[" ${text} "${${text}}")
      string(REPLACE "<lockstep-close>" "]" ${text} "${${text}}")
    endforeach()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    add_test(NAME "${file}: ${scenario}"
      COMMAND ${LOCKSTEP_PROGRAM} test ${file} --filter "${scenario}"
              --out ${CMAKE_CURRENT_BINARY_DIR}/failed-scenarios ${TESTS_OPTIONS}
      WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  endforeach()
endfunction()
