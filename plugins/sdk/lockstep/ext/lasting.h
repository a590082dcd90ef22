/* lockstep/ext/lasting.h: constants of ports by pointer. */
#ifndef LOCKSTEP_EXT_LASTING_H
#define LOCKSTEP_EXT_LASTING_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What stays as it is as long as a leaf is there, for one that uses it often: it reads
 * there in place of a call. Found with get_extension(LOCKSTEP_LASTING). */
typedef struct lockstep_lasting {
  uint32_t struct_size;

  /* [run] The constant of a port of type bool, int or double: a const bool *, const int64_t * or
   * const double *, valid until destroy returns. NULL: the port is bound to an entry, or has no
   * value of this type. */
  const void* (*constant)(const lockstep_caller* caller, uint32_t port, lockstep_type type);
  /* [run] False: no entry is bound to the port, and set does nothing but return false. */
  bool (*is_set)(const lockstep_caller* caller, uint32_t port);
} lockstep_lasting;

#define LOCKSTEP_LASTING "lockstep.lasting"

#ifdef __cplusplus
}
#endif

#endif
