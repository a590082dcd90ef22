// The functions of an isolated plugin that the engine and LeafSet call. Each sends its call to the
// process of the run, with what the leaf may read, and returns what the leaf has set.
#pragma once

#include "lockstep/leaf.h"

namespace lockstep {

// The proxies; everything else in them is zero.
const lockstep_plugin& remote_plugin();
const lockstep_leaf_type& remote_leaf_type();

}  // namespace lockstep
