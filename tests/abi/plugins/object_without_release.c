#include "lockstep/leaf.h"

static const lockstep_object_type path = {
    sizeof(lockstep_object_type), "nav.Path", NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
#define PORT_TYPE LOCKSTEP_OBJECT
#define PORT_DEFAULT NULL
#define PORT_OBJECT &path
#include "entry.h"
