// ManualSelectorNode: there is none here; the compiler says so where one is made.
#pragma once

#include "behaviortree_cpp/lockstep/absent_node.h"  // IWYU pragma: export
