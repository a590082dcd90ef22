/* Its port carries objects. */
#include "lockstep/leaf.h"

static void count(void* object) {
  (void)object;
}
static const lockstep_object_type path = {
    sizeof(lockstep_object_type), "nav.Path", count, count, NULL, NULL, NULL, NULL, NULL, NULL};
#define PORT_TYPE LOCKSTEP_OBJECT
#define PORT_DEFAULT NULL
#define PORT_OBJECT &path
#include "entry.h"
