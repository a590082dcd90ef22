/* A leaf whose kept progress is not what its function returns. */
#include "probe.h"

#include <string.h>

static double progress(void* leaf) {
  (void)leaf;
  return 0.5;
}
static const void* get_extension(void* leaf, const char* id) {
  static const double kept = 0.25;
  (void)leaf;
  return strcmp(id, LOCKSTEP_KEPT_PROGRESS) == 0 ? &kept : NULL;
}
#define LEAF_PROGRESS progress
#define LEAF_GET_EXTENSION get_extension
#include "entry.h"
