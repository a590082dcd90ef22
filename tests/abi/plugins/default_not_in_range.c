#define PORT_MIN 3
#define PORT_MAX 4
#include "entry.h"
