// Switch2 to Switch6 in trees: tags, not classes.
#pragma once

#include "behaviortree_cpp/lockstep/absent_node.h"  // IWYU pragma: export
