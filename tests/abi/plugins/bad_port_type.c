#define PORT_TYPE 9
#include "entry.h"
