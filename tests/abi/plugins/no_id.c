#define LEAF_ID NULL
#include "entry.h"
