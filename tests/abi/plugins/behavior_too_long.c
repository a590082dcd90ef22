#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"ticks", "2"}};
#define LEAF_BEHAVIOR_COUNT 4097
#define LEAF_BEHAVIOR said
#include "entry.h"
