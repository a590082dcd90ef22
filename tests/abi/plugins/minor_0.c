/* Of a plugin built for 1.0 nothing lies behind get_extension: what is there is not its own. */
#define ABI_MINOR 0
#define LEAF_SIZE offsetof(lockstep_leaf_type, flags)
#define LEAF_FLAGS LOCKSTEP_REAL_TIME
#include "entry.h"
