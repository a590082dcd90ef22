// The functions of nodes and of what registers them: nothing here needs the runtime, so that a
// plugin can be linked with it.
#undef LOCKSTEP_BTCPP_LIBRARY
#define LOCKSTEP_BTCPP_MAKES_LIBRARY
#include "behaviortree_cpp/bt_factory.h"
