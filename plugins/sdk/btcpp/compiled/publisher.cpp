// Groot2. A program that does not show its trees there is linked without this.
#ifndef LOCKSTEP_BTCPP_LIBRARY
#define LOCKSTEP_BTCPP_LIBRARY  // the functions of nodes.cpp are not here
#endif
#include "behaviortree_cpp/lockstep/program.h"
// The functions of programs.cpp are not here either: only those that follow are the library's.
#undef LOCKSTEP_BTCPP_INLINE
#define LOCKSTEP_BTCPP_INLINE
#include "behaviortree_cpp/lockstep/compiled/groot2_publisher.h"
