# What the compiler must say to each mistake in btcpp_mistakes.cpp.
#   cmake -DSOURCES=… -DCXX_COMPILER=… -DSOURCE=…/btcpp_mistakes.cpp -P btcpp_mistakes.cmake
cmake_minimum_required(VERSION 3.20)

set(said_1 "the default of a port is a value of its type, or a text")
set(said_2 "this class is abstract: it lacks a function that its base asks for")
set(said_3 "needs a public function: static BT::PortsList providedPorts")
set(said_4 "a class with providedPorts.. needs a public constructor")
set(said_5 "a class of nodes derives from a node of BT")
set(said_6 "lockstep has no Groot2Publisher: 'lockstep run --groot2'")
set(said_7 "lockstep has no writeTreeNodesModelXML")
set(said_8 "lockstep has this node of the library as a tag, not as a class")
set(said_9 "lockstep has no substitution rules")
set(said_10 "lockstep gives scripts to no C.. code: write a Script node")
set(said_11 "lockstep has the protocol of Groot2 as an option, not as a header")
set(said_12 "lockstep has no polymorphic casts")
set(said_13 "lockstep has no FileLogger2" "lockstep has no SqliteLogger" "lockstep has no MinitraceLogger"
            "lockstep has no TreeObserver" "lockstep has no WriteTreeToXML"
            "lockstep has this node of the library as a tag, not as a class"
            "TestNode" "SwitchNode" "TimeoutNode")
set(said_14 "ParseScript" "lockstep keeps no backups of a blackboard" "T = BT::ParallelNode" "T = BT::ScriptNode")

include(${CMAKE_CURRENT_LIST_DIR}/check_mistakes.cmake)
check_mistakes(14 -I${SOURCES}/plugins/sdk -I${SOURCES}/plugins/sdk/btcpp/include
               -I${SOURCES}/interpreter/embedding)
