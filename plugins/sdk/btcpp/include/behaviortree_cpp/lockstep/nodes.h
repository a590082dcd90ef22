// The classes of the nodes that every tree has, as the library names them.
#pragma once

#include "behaviortree_cpp/actions/always_failure_node.h"                 // IWYU pragma: export
#include "behaviortree_cpp/actions/always_success_node.h"                 // IWYU pragma: export
#include "behaviortree_cpp/actions/test_node.h"                           // IWYU pragma: export
#include "behaviortree_cpp/controls/fallback_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/controls/reactive_fallback.h"                  // IWYU pragma: export
#include "behaviortree_cpp/controls/reactive_sequence.h"                  // IWYU pragma: export
#include "behaviortree_cpp/controls/sequence_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/controls/sequence_with_memory_node.h"          // IWYU pragma: export
#include "behaviortree_cpp/decorators/force_failure_node.h"               // IWYU pragma: export
#include "behaviortree_cpp/decorators/force_success_node.h"               // IWYU pragma: export
#include "behaviortree_cpp/decorators/inverter_node.h"                    // IWYU pragma: export
#include "behaviortree_cpp/decorators/keep_running_until_failure_node.h"  // IWYU pragma: export
#include "behaviortree_cpp/decorators/loop_node.h"                        // IWYU pragma: export
#include "behaviortree_cpp/decorators/repeat_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/decorators/retry_node.h"                       // IWYU pragma: export
#include "behaviortree_cpp/decorators/run_once_node.h"                    // IWYU pragma: export
#include "behaviortree_cpp/lockstep/absent_node.h"                        // IWYU pragma: export
