#define PLUGIN_SIZE 24
#include "entry.h"
