#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"ticks", "4..2"}};
#define LEAF_BEHAVIOR_COUNT sizeof said / sizeof *said
#define LEAF_BEHAVIOR said
#include "entry.h"
