#include "probe.h"

static void start(void* leaf) {
  probe_fail(leaf, "no power");
}
#define LEAF_START start
#include "entry.h"
