#define PORT_DIRECTION LOCKSTEP_OUTPUT
#include "entry.h"
