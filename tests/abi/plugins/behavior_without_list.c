#define LEAF_BEHAVIOR_COUNT 1
#include "entry.h"
