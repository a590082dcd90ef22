/* An action that asks for children. */
#define LEAF_TICK ask
#include "probe.h"

static lockstep_status ask(void* leaf);

#include "entry.h"

static lockstep_status ask(void* leaf) {
  const probe* it = (const probe*)leaf;
  const lockstep_children* children = it->host->get_extension(LOCKSTEP_CHILDREN);
  return children->tick(it->caller, 0);
}
