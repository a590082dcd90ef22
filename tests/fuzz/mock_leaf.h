// A linked-in plugin of leaves that do what a text says, right or wrong, and that abort when the
// host breaks the contract of lockstep/leaf.h. For the fuzz targets only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lockstep/leaf.h"

namespace lockstep::host::fuzz {

// Leaves 'Mock' (an action with every function), 'MockCondition', 'MockBare' (an action that has
// only tick). Each tick plays one letter of the port 'script', over and over:
//   R S F   running, success, failure         0-9  running, with the progress 0/9 to 9/9
//   ?       one of the three, by chance       N P Q  running; progress is NaN, -1, 2
//   X T     set_error, throw in tick          B    status 7
//   x t     the same in start                 h p u g  set_error in halt, pause, resume, progress
//   c       set_error in create, if it is the first letter
constexpr std::string_view kLetters = "RSF0123456789?NPQXTBxthpugc";
extern const lockstep_plugin kMockPlugin;

// What all leaves were told since it was last taken.
std::string take_events();
// Of the tree, which a leaf must see at most one tick of.
void begin_tick();
// Leaves that were created and not destroyed.
int living_leaves();

}  // namespace lockstep::host::fuzz
