#define PLUGIN_NAME NULL
#include "entry.h"
