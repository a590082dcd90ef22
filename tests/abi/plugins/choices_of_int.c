#define PORT_CHOICES "1;2"
#include "entry.h"
