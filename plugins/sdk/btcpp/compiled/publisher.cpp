// Groot2. A program that does not show its trees there is linked without this.
#ifndef LOCKSTEP_BTCPP_LIBRARY
#define LOCKSTEP_BTCPP_LIBRARY  // the functions of nodes.cpp are not here
#endif
#define LOCKSTEP_BTCPP_MAKES_LIBRARY
#include "behaviortree_cpp/lockstep/compiled/groot2_publisher.h"
