// The functions of programs that tick trees.
#define LOCKSTEP_BTCPP_LIBRARY
#define LOCKSTEP_BTCPP_MAKES_LIBRARY
#include "behaviortree_cpp/lockstep/compiled/factory_programs.h"
#include "behaviortree_cpp/lockstep/compiled/xml_parsing.h"
