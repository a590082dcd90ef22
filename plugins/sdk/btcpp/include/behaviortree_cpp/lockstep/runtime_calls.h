// The functions of lockstep/runtime.h, as these headers call them. A plugin with all functions has
// also those for programs, as virtual ones and where the compiler guesses which is called. None of
// them runs without the library of a program, so the plugin loads without it.
#pragma once

#include "behaviortree_cpp/lockstep/inline.h"
#if LOCKSTEP_BTCPP_HAS_FUNCTIONS && defined(BT_PLUGIN_EXPORT) && !defined(LOCKSTEP_RUNTIME_EXPORT)
#define LOCKSTEP_RUNTIME_EXPORT LOCKSTEP_EXPORT __attribute__((weak))
#endif
#include <lockstep/runtime.h>
