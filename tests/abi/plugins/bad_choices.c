#define PORT_TYPE LOCKSTEP_STRING
#define PORT_DEFAULT "a"
#define PORT_CHOICES "a;b;a"
#include "entry.h"
