#define LEAF_CREATE NULL
#include "entry.h"
