#define PORT_NAME NULL
#include "entry.h"
