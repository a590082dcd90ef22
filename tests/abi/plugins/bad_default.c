#define PORT_DEFAULT "two"
#include "entry.h"
