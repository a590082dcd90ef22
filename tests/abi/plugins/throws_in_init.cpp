#include "probe.h"

static bool init(const lockstep_host*, const lockstep_caller*) {
  throw 42;
}
#define PLUGIN_INIT init
#include "entry.h"
