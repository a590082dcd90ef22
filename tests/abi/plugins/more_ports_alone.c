#define LEAF_MORE_PORTS "goal.*"
#include "entry.h"
