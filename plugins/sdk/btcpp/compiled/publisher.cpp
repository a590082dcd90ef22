// Groot2. A program that does not show its trees there is linked without this.
#define LOCKSTEP_BTCPP_LIBRARY
#define LOCKSTEP_BTCPP_MAKES_LIBRARY
#include "behaviortree_cpp/lockstep/compiled/groot2_publisher.h"
