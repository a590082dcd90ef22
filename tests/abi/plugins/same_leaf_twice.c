#define LEAF_COUNT 2
#include "entry.h"
