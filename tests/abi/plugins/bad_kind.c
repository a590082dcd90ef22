#define LEAF_KIND 5
#include "entry.h"
