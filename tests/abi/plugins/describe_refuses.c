#include "lockstep/leaf.h"
static const lockstep_plugin* describe(const char** why) {
  *why = "two nodes are called 'Grasp'";
  return NULL;
}
#define PLUGIN_DESCRIBE describe
#include "entry.h"
