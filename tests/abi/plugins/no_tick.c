#define LEAF_TICK NULL
#include "entry.h"
