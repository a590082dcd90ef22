#include "probe.h"

static bool init(const lockstep_host*) {
  throw 42;
}
#define PLUGIN_INIT init
#include "entry.h"
