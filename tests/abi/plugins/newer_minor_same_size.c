#define ABI_MINOR 7
#include "entry.h"
