#define PORT_TYPE 6
#include "entry.h"
