#include "probe.h"

static void destroy(void* leaf) {
  probe_destroy(leaf);
  throw 42;
}
#define LEAF_DESTROY destroy
#include "entry.h"
