#define LEAF_LIST NULL
#include "entry.h"
