// The functions of a plugin that is a program, as the host calls them: they say to the program what
// they were called for, and return what it answers.
#pragma once

#include "lockstep/leaf.h"

namespace lockstep {

const lockstep_plugin& program_functions();
const lockstep_leaf_type& program_leaf_functions();

}  // namespace lockstep
