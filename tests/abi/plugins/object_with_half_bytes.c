#include "lockstep/leaf.h"

static void count(void* object) {
  (void)object;
}
static size_t to_bytes(const void* object, void* bytes, size_t size) {
  (void)object;
  (void)bytes;
  return size;
}
static const lockstep_object_type path = {
    sizeof(lockstep_object_type), "nav.Path", count, count, NULL, NULL, to_bytes, NULL, NULL, NULL};
#define PORT_TYPE LOCKSTEP_OBJECT
#define PORT_DEFAULT NULL
#define PORT_OBJECT &path
#include "entry.h"
