#define PORT_SIZE 8
#include "entry.h"
