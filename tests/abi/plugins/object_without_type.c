#define PORT_TYPE LOCKSTEP_OBJECT
#define PORT_DEFAULT NULL
#include "entry.h"
