#define LEAF_COUNT 5000
#include "entry.h"
