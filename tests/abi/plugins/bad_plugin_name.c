#define PLUGIN_NAME "../x"
#include "entry.h"
