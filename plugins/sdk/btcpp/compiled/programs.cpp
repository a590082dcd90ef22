// The functions of programs that tick trees.
#ifndef LOCKSTEP_BTCPP_LIBRARY
#define LOCKSTEP_BTCPP_LIBRARY  // the functions of nodes.cpp are not here
#endif
#define LOCKSTEP_BTCPP_MAKES_LIBRARY
#include "behaviortree_cpp/lockstep/compiled/factory_programs.h"
#include "behaviortree_cpp/lockstep/compiled/xml_parsing.h"
