#define LEAF_FLAGS (LOCKSTEP_REAL_TIME | 1024)
#include "entry.h"
