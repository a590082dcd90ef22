#define LEAF_ID "BehaviorTree"
#include "entry.h"
