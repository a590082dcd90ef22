#define PORT_LIST no_ports
#include "lockstep/leaf.h"
static const lockstep_port* const no_ports[] = {0};
#include "entry.h"
