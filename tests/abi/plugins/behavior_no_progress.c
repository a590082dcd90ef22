#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"progress", "grid:10"}};
#define LEAF_BEHAVIOR_COUNT sizeof said / sizeof *said
#define LEAF_BEHAVIOR said
#include "entry.h"
