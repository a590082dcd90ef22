#include <stdlib.h>

#include "lockstep/leaf.h"
static bool init(const lockstep_host* host, const lockstep_caller* caller) {
  (void)host;
  (void)caller;
  exit(3);
}
#define PLUGIN_INIT init
#include "entry.h"
