#define PORT_NAME "2nd"
#include "entry.h"
