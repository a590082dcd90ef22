#define PLUGIN_NAME "good"
#define LEAF_ID "Twin"
#include "entry.h"
