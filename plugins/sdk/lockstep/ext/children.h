/* lockstep/ext/children.h: what a control node or decorator does with its children. */
#ifndef LOCKSTEP_EXT_CHILDREN_H
#define LOCKSTEP_EXT_CHILDREN_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a control node or decorator does with its children, which it names by index, from
 * 0. Found with get_extension(LOCKSTEP_CHILDREN); a host that loads such a node has it.
 *
 * tick, halt and pause are called inside the node's own tick only; count, status and progress
 * inside any function of the node but create and destroy. It is a fault of the node to call them
 * elsewhere, to name a child that it does not have, or (in lockstep's own language) to tick a child
 * twice in one tick. After a fault, also one of a leaf below, they do nothing, tick and status
 * return LOCKSTEP_RUNNING, and what the node returns does not count.
 *
 * The host keeps the rest in order. When the node completes, children that still run are halted.
 * When the node is halted or paused, so are its children, before its own function is called; with
 * LOCKSTEP_HALTS_CHILDREN, after its halt. A child that runs and is not ticked continues by itself,
 * unless it was paused or halted. */
typedef struct lockstep_children {
  uint32_t struct_size;

  /* [run] */
  uint32_t (*count)(const lockstep_caller* caller);
  /* [run] Ticks a child; its first tick starts it, and a tick after a pause resumes it. */
  lockstep_status (*tick)(const lockstep_caller* caller, uint32_t child);
  /* [run] Ends the activation of a child that runs; after it the child is idle. */
  void (*halt)(const lockstep_caller* caller, uint32_t child);
  /* [run] Holds a child that runs, until it is ticked again. */
  void (*pause)(const lockstep_caller* caller, uint32_t child);
  /* [run] The result of its last tick; LOCKSTEP_IDLE before its first one, and after a halt. */
  lockstep_status (*status)(const lockstep_caller* caller, uint32_t child);
  /* [run] In [0, 1]: 1 after success, 0 when it failed or is idle. */
  double (*progress)(const lockstep_caller* caller, uint32_t child);
  /* [run] Ticks a child that may have completed before, as tick does; but one that has completed
   * does not begin again: it receives start_unreset
   * (optional) in place of start, and continues from its last result. An action that takes time
   * and has no start_unreset is not ticked; it gives the same result. */
  lockstep_status (*tick_unreset)(const lockstep_caller* caller, uint32_t child);
} lockstep_children;

#define LOCKSTEP_CHILDREN "lockstep.children"

#ifdef __cplusplus
}
#endif

#endif
