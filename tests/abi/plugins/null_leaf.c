#define LEAF_LIST no_leaves
#include "lockstep/leaf.h"
static const lockstep_leaf_type* const no_leaves[] = {0};
#include "entry.h"
