#define PORT_MIN 2
#define PORT_MAX 1
#include "entry.h"
