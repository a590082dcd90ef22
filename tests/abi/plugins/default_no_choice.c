#define PORT_TYPE LOCKSTEP_STRING
#define PORT_CHOICES "one;three"
#include "entry.h"
