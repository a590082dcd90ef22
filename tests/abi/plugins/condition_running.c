#include "probe.h"

#define LEAF_KIND LOCKSTEP_CONDITION
#include "entry.h"
