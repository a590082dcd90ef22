// EntryUpdatedDecorator in trees: a tag, not a class.
#pragma once

#include "behaviortree_cpp/lockstep/absent_node.h"  // IWYU pragma: export
