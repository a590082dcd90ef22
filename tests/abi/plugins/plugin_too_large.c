#define PLUGIN_SIZE 4000
#include "entry.h"
