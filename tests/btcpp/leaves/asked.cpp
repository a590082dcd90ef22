// A condition of WhileDoElse is asked in each tick and not reset in between.
#include "own_status.h"

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Ask>("Ask");
  factory.registerNodeType<Raw>("Raw");
  factory.registerNodeType<Steps>("Steps");
}
