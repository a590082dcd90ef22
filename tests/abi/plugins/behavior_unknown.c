#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"tick", "2..4"}};
#define LEAF_BEHAVIOR_COUNT sizeof said / sizeof *said
#define LEAF_BEHAVIOR said
#include "entry.h"
