// The classes of the nodes that every tree has, as the library names them. Generated from
// the headers that there are: ./dev generate.
#pragma once

#include "behaviortree_cpp/actions/always_failure_node.h"                 // IWYU pragma: export
#include "behaviortree_cpp/actions/always_success_node.h"                 // IWYU pragma: export
#include "behaviortree_cpp/actions/script_condition.h"                    // IWYU pragma: export
#include "behaviortree_cpp/actions/script_node.h"                         // IWYU pragma: export
#include "behaviortree_cpp/actions/set_blackboard_node.h"                 // IWYU pragma: export
#include "behaviortree_cpp/actions/sleep_node.h"                          // IWYU pragma: export
#include "behaviortree_cpp/actions/test_node.h"                           // IWYU pragma: export
#include "behaviortree_cpp/actions/unset_blackboard_node.h"               // IWYU pragma: export
#include "behaviortree_cpp/actions/updated_action.h"                      // IWYU pragma: export
#include "behaviortree_cpp/controls/fallback_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/controls/if_then_else_node.h"                  // IWYU pragma: export
#include "behaviortree_cpp/controls/manual_node.h"                        // IWYU pragma: export
#include "behaviortree_cpp/controls/parallel_all_node.h"                  // IWYU pragma: export
#include "behaviortree_cpp/controls/parallel_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/controls/reactive_fallback.h"                  // IWYU pragma: export
#include "behaviortree_cpp/controls/reactive_sequence.h"                  // IWYU pragma: export
#include "behaviortree_cpp/controls/sequence_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/controls/sequence_with_memory_node.h"          // IWYU pragma: export
#include "behaviortree_cpp/controls/switch_node.h"                        // IWYU pragma: export
#include "behaviortree_cpp/controls/try_catch_node.h"                     // IWYU pragma: export
#include "behaviortree_cpp/controls/while_do_else_node.h"                 // IWYU pragma: export
#include "behaviortree_cpp/decorators/delay_node.h"                       // IWYU pragma: export
#include "behaviortree_cpp/decorators/force_failure_node.h"               // IWYU pragma: export
#include "behaviortree_cpp/decorators/force_success_node.h"               // IWYU pragma: export
#include "behaviortree_cpp/decorators/inverter_node.h"                    // IWYU pragma: export
#include "behaviortree_cpp/decorators/keep_running_until_failure_node.h"  // IWYU pragma: export
#include "behaviortree_cpp/decorators/loop_node.h"                        // IWYU pragma: export
#include "behaviortree_cpp/decorators/repeat_node.h"                      // IWYU pragma: export
#include "behaviortree_cpp/decorators/retry_node.h"                       // IWYU pragma: export
#include "behaviortree_cpp/decorators/run_once_node.h"                    // IWYU pragma: export
#include "behaviortree_cpp/decorators/script_precondition.h"              // IWYU pragma: export
#include "behaviortree_cpp/decorators/subtree_node.h"                     // IWYU pragma: export
#include "behaviortree_cpp/decorators/timeout_node.h"                     // IWYU pragma: export
#include "behaviortree_cpp/decorators/updated_decorator.h"                // IWYU pragma: export
