#define PORT_TYPE LOCKSTEP_STRING
#define PORT_MAX 1
#include "entry.h"
