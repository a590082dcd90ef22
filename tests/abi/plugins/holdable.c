/* A leaf that leaves it to the tree what its robot does while it is held. */
#define LEAF_FLAGS LOCKSTEP_REAL_TIME
#define PORT_NAME "hold"
#define PORT_TYPE LOCKSTEP_STRING
#define PORT_DEFAULT NULL
#define PORT_FLAGS (LOCKSTEP_FIXED | LOCKSTEP_OPTIONAL)
#include "entry.h"
