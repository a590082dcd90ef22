#include "probe.h"

static void halt(void* leaf) {
  probe_fail(leaf, "stuck brake");
}
#define LEAF_HALT halt
#include "entry.h"
