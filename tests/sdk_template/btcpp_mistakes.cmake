# What the compiler must say to each mistake in btcpp_mistakes.cpp.
#   cmake -DSOURCES=… -DCXX_COMPILER=… -DSOURCE=…/btcpp_mistakes.cpp -P btcpp_mistakes.cmake
cmake_minimum_required(VERSION 3.20)

set(said_1 "the default of a port is a value of its type, or a text")
set(said_2 "this class is abstract: it lacks a function that its base asks for")
set(said_3 "needs a public function: static BT::PortsList providedPorts")
set(said_4 "a class with providedPorts.. needs a public constructor")
set(said_5 "a class of nodes derives from a node of BT")
set(said_6 "lockstep has no Groot2Publisher: 'lockstep run --view live'")
set(said_7 "lockstep has no nodes of a tree as objects")

foreach(mistake RANGE 7)
  execute_process(
    COMMAND ${CXX_COMPILER} -std=c++17 -fsyntax-only -I${SOURCES}/plugins/sdk
            -I${SOURCES}/plugins/sdk/btcpp/include -I${SOURCES}/interpreter/embedding
            -DMISTAKE=${mistake} ${SOURCE}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(mistake EQUAL 0 AND NOT result EQUAL 0)
    message(FATAL_ERROR "the plugin without a mistake is refused:\n${output}")
  elseif(mistake GREATER 0 AND result EQUAL 0)
    message(SEND_ERROR "mistake ${mistake} compiles")
  elseif(mistake GREATER 0 AND NOT output MATCHES "${said_${mistake}}")
    message(SEND_ERROR "mistake ${mistake}: '${said_${mistake}}' is not in\n${output}")
  endif()
endforeach()
