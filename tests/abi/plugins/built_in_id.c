#define LEAF_ID "Sequence"
#include "entry.h"
