/* The headers compile alone, before anything else is included. */
#include "lockstep/ext/changes.h"
#include "lockstep/leaf.h"
#include "lockstep/ext/ticks.h"

int lockstep_header_in_c(const lockstep_plugin* plugin);
int lockstep_header_in_c(const lockstep_plugin* plugin) {
  return plugin->abi_major == LOCKSTEP_ABI_MAJOR;
}
