#define PORT_LIST NULL
#include "entry.h"
