#include "lockstep/leaf.h"
static const lockstep_plugin other = {LOCKSTEP_ABI_MAJOR + 1,
                                      0,
                                      sizeof(lockstep_plugin),
                                      "x",
                                      NULL,
                                      NULL,
                                      0,
                                      NULL,
                                      NULL,
                                      NULL,
                                      NULL,
                                      NULL,
                                      NULL,
                                      NULL};
static const lockstep_plugin* describe(const char** why) {
  (void)why;
  return &other;
}
#define PLUGIN_DESCRIBE describe
#include "entry.h"
