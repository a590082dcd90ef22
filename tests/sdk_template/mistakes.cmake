# What the compiler must say to each mistake in mistakes.cpp.
#   cmake -DSDK=… -DCXX_COMPILER=… -DSOURCE=…/mistakes.cpp -P mistakes.cmake
cmake_minimum_required(VERSION 3.20)

set(said_1 "error_two_ports_have_the_same_name")
set(said_2 "error_default_is_not_a_value_of_the_port_type")
set(said_3 "a port is of type bool, std::int64_t, double")
set(said_4 "error_name_must_be_letters_digits_and_underscores")
set(said_5 "error_port_name_is_reserved_by_the_tree_language")
set(said_6 "no member named")
set(said_7 "discards qualifiers|not marked const")
set(said_8 "private")
set(said_9 "override")
set(said_10 "error_two_leaves_have_the_same_id")
set(said_11 "error_name_must_be_letters_digits_and_underscores")
set(said_12 "error_an_output_has_no_default")
set(said_13 "error_an_output_has_no_default")
set(said_14 "error_default_is_not_a_value_of_the_port_type")
set(said_15 "an output is an int or a double, not either")

foreach(mistake RANGE 15)
  execute_process(
    COMMAND ${CXX_COMPILER} -std=c++17 -fsyntax-only -I${SDK} -DMISTAKE=${mistake} ${SOURCE}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(mistake EQUAL 0 AND NOT result EQUAL 0)
    message(FATAL_ERROR "the plugin without a mistake is refused:\n${output}")
  elseif(mistake GREATER 0 AND result EQUAL 0)
    message(SEND_ERROR "mistake ${mistake} compiles")
  elseif(mistake GREATER 0 AND NOT output MATCHES "${said_${mistake}}")
    message(SEND_ERROR "mistake ${mistake}: '${said_${mistake}}' is not in\n${output}")
  endif()
endforeach()
