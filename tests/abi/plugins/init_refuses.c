#include "lockstep/leaf.h"
static bool init(const lockstep_host* host, const lockstep_caller* caller) {
  (void)host;
  (void)caller;
  return false;
}
#define PLUGIN_INIT init
#include "entry.h"
