#define PORT_COUNT 2
#include "entry.h"
