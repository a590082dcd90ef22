#define LEAF_KIND LOCKSTEP_CONTROL
#define LEAF_MIN_CHILDREN 3
#define LEAF_MAX_CHILDREN 2
#include "entry.h"
