#include "probe.h"

static lockstep_status tick(void*) {
  throw 42;
}
#define LEAF_TICK tick
#include "entry.h"
