#define LEAF_SIZE 40
#include "entry.h"
