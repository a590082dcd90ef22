#include "probe.h"

static lockstep_status tick(void* leaf) {
  probe_fail(leaf, "lost the arm");
  probe_fail(leaf, "a second message");
  return LOCKSTEP_SUCCESS;
}
#define LEAF_TICK tick
#include "entry.h"
