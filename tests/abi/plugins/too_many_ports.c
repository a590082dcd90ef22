#define PORT_COUNT 4097
#include "entry.h"
