#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"ticks", "2"}};
#define LEAF_BEHAVIOR_COUNT sizeof said / sizeof *said
#define LEAF_BEHAVIOR said
#define LEAF_FLAGS LOCKSTEP_AT_ONCE
#include "entry.h"
