# What the compiler must say to each mistake in btcpp_mistakes.cpp.
#   cmake -DSOURCES=… -DCXX_COMPILER=… -DSOURCE=…/btcpp_mistakes.cpp -P btcpp_mistakes.cmake
cmake_minimum_required(VERSION 3.20)

set(said_1 "the default of a port is a value of its type, or a text")
set(said_2 "this class is abstract: it lacks a function that its base asks for")
set(said_3 "needs a public function: static BT::PortsList providedPorts")
set(said_4 "a class with providedPorts.. needs a public constructor")
set(said_5 "a class of nodes derives from a node of BT")
set(said_6 "lockstep has no SqliteLogger: FileLogger2 writes a log")
set(said_7 "T = BT::TestNode")
set(said_8 "lockstep has no ManualSelector")
set(said_9 "lockstep has this node of the library as a tag, not as a class" "T = BT::ScriptNode")
set(said_10 "lockstep has no publisher for Groot 1")
set(said_11 "registerPolymorphicCast<Derived, Base>: Derived does not derive from Base")
set(said_12 "no matching function for call to .*BT::PortInfo::PortInfo")

include(${CMAKE_CURRENT_LIST_DIR}/check_mistakes.cmake)
check_mistakes_at_once(12 -DLOCKSTEP_BTCPP_LIBRARY -I${SOURCES}/plugins/sdk -I${SOURCES}/plugins/sdk/btcpp/include
                       -I${SOURCES}/interpreter/embedding)
