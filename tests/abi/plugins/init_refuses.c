#include "lockstep/leaf.h"
static bool init(const lockstep_host* host) {
  (void)host;
  return false;
}
#define PLUGIN_INIT init
#include "entry.h"
