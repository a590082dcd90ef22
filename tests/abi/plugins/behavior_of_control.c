#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"result", "success"}};
#define LEAF_BEHAVIOR_COUNT sizeof said / sizeof *said
#define LEAF_BEHAVIOR said
#define LEAF_KIND LOCKSTEP_CONTROL
#include "entry.h"
