#define LEAF_DESTROY NULL
#include "entry.h"
