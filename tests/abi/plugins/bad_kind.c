#define LEAF_KIND 3
#include "entry.h"
