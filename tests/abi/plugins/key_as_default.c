#define PORT_TYPE LOCKSTEP_STRING
#define PORT_DEFAULT "{key}"
#include "entry.h"
