/* A plugin that speaks to the terminal wherever lockstep shows a text of it. Which of its texts do
 * is chosen when it is compiled: LOUD_leaf, what a plugin may say; LOUD_name and LOUD_init, what it
 * is refused for.
 */
#include "probe.h"

/* A title for the window and a bell; CSI as one character; the text behind it from right to left.
 */
#define LOUD                 \
  "\033]2;loud\007 \302\233" \
  "31m \342\200\256 loud"

#ifdef LOUD_leaf
static lockstep_status tick(void* leaf) {
  probe_log(leaf, "logs " LOUD);
  probe_fail(leaf, "fails " LOUD);
  return LOCKSTEP_SUCCESS;
}
#define LEAF_TICK tick
#define LEAF_DOC "a leaf " LOUD
#endif

#ifdef LOUD_name
#define PLUGIN_NAME "name" LOUD
#endif

#ifdef LOUD_init
static bool init(const lockstep_host* host, const lockstep_caller* caller) {
  host->set_error(caller, "init " LOUD);
  return false;
}
#define PLUGIN_INIT init
#endif

#include "entry.h"
