#define PORT_DIRECTION 0
#include "entry.h"
