#define PORT_DEFAULT "2"
#define PORT_FLAGS LOCKSTEP_DEFAULT_ENTRY
#include "entry.h"
