#define PORT_NAME "ID"
#include "entry.h"
