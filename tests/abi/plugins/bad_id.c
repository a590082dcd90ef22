#define LEAF_ID "Pro be"
#include "entry.h"
