/* lockstep/ext/more_ports.h: ports by pattern, which a leaf type finds out from what an element
 * has. */
#ifndef LOCKSTEP_EXT_MORE_PORTS_H
#define LOCKSTEP_EXT_MORE_PORTS_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* lockstep_leaf_type::more_ports has the names that an element may have more ports by, such as
 * "goal.*;result.*"; NULL: none. Which ports an element has is found out when a tree is loaded, by
 * what it gives to the ports with LOCKSTEP_FIXED.
 *
 * lockstep_leaf_type::describe [any] returns the type of an element with these constants: of the
 * same id and kind, with all its ports, the fixed ones among them, and without describe. The same
 * constants give the same type, which is valid until the end of the process. NULL: there is none,
 * and why. `lockstep check` and editors call it too, before init. */

/* What an element gives to a port with LOCKSTEP_FIXED, or the port's default. */
struct lockstep_fixed {
  const char* port;
  const char* text;
};

/* Why an element has no type. The texts are valid until the thread calls describe again;
 * the host has set all to NULL, and struct_size. */
struct lockstep_refusal {
  uint32_t struct_size;
  const char* port;    /* whose text is wrong; NULL: the element as a whole */
  const char* message; /* lower case, names in single quotes, no full stop */
  const char* hint;    /* what to do; NULL for none */
};

#ifdef __cplusplus
}
#endif

#endif
