#define PORT_TYPE 10
#include "entry.h"
