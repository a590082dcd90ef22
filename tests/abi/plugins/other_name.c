#define PLUGIN_NAME "something_else"
#include "entry.h"
