#include <lockstep/leaf.h>
static const lockstep_behavior said[] = {{"out.ticks", "2|many"}};
#define LEAF_BEHAVIOR_COUNT sizeof said / sizeof *said
#define LEAF_BEHAVIOR said
#define PORT_DIRECTION LOCKSTEP_OUTPUT
#define PORT_DEFAULT NULL
#include "entry.h"
