#include "probe.h"

static void* create(const lockstep_host*, const lockstep_caller*, void*) {
  throw 42;
}
#define LEAF_CREATE create
#include "entry.h"
