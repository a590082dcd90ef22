/* lockstep/ext/place.h: what a node knows about its place in the tree; ports of any type. */
#ifndef LOCKSTEP_EXT_PLACE_H
#define LOCKSTEP_EXT_PLACE_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a node may know about its place in the tree, and ports of type LOCKSTEP_ANY.
 * Found with get_extension(LOCKSTEP_PLACE). Texts are valid until destroy returns. */
typedef struct lockstep_place {
  uint32_t struct_size;

  /* [any] The name of the node in the tree, which is its id unless the tree gives another; and all
   * names from the root down to it, unique in the tree. */
  const char* (*name)(const lockstep_caller* caller);
  const char* (*path)(const lockstep_caller* caller);
  /* [any] The id of its type, for those whose types share a `create`. */
  const char* (*id)(const lockstep_caller* caller);
  /* [any] The id and the name of a child, by its index; NULL when there is none. */
  const char* (*child_id)(const lockstep_caller* caller, uint32_t child);
  const char* (*child_name)(const lockstep_caller* caller, uint32_t child);

  /* [run] What the tree gives to a port: "{key}", or the text of a constant; NULL when it is left
   * out and has no default. */
  const char* (*given)(const lockstep_caller* caller, uint32_t port);
  /* [run] The type of the value that a port has now, of which the get of that type returns it; 0
   * when there is none. */
  lockstep_type (*value_type)(const lockstep_caller* caller, uint32_t port);
  /* [run] get_object and set_object for a LOCKSTEP_ANY: false when it has an object of another
   * type, or none. The type must be one that a port of the plugin could have. */
  bool (*get_object)(const lockstep_caller* caller, uint32_t port, const lockstep_object_type* type,
                     void** object);
  bool (*set_object)(const lockstep_caller* caller, uint32_t port, const lockstep_object_type* type,
                     void* object);

  /* [run] The index of a port beyond those of the type: of type LOCKSTEP_ANY, an inout, bound to
   * the entry that `key` means where the node is in the tree. The same key gives the same index.
   * UINT32_MAX: the type has not LOCKSTEP_OPENS, it is create that runs, or the tree is in a
   * language without such entries. */
  uint32_t (*open)(const lockstep_caller* caller, const char* key, size_t length);
  /* [run] Removes the entry of a port that was opened, if it belongs to the node's own tree. */
  void (*unset)(const lockstep_caller* caller, uint32_t port);

  /* [run] In tick: where the tree is in a language whose nodes request it, it is ticked once more
   * in this period if its root runs then. */
  void (*ask_for_tick)(const lockstep_caller* caller);

  /* [any] The tree is ticked at once, by the program that
   * waits for its next period, or right after the current tick. Only for a type with
   * LOCKSTEP_WAKES. Nothing happens on the virtual clock, where a period takes no time, and in a
   * separate process. It never waits. */
  void (*wake)(const lockstep_caller* caller);

  /* [any] lockstep_leaf_type::data of the node's type: of the one that describe returned
   * for its element. */
  const void* (*data)(const lockstep_caller* caller);

  /* Since 1.5. [any] The language of the tree, by the attribute of its root: "lockstep" or
   * "BTCPP_format". In the second one a child may be ticked again in the same tick, and a parent
   * resets its children: start_unreset. NULL: in a separate process, which has no control nodes. */
  const char* (*language)(const lockstep_caller* caller);
} lockstep_place;

#define LOCKSTEP_PLACE "lockstep.place"

#ifdef __cplusplus
}
#endif

#endif
