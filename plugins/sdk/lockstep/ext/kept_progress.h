/* lockstep/ext/kept_progress.h: a progress that the host reads without a call. */
#ifndef LOCKSTEP_EXT_KEPT_PROGRESS_H
#define LOCKSTEP_EXT_KEPT_PROGRESS_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a leaf keeps its progress, for one that has it as a number: a const double *,
 * from lockstep_leaf_type::get_extension, valid until destroy. The host may read the number
 * wherever it would call progress, which the leaf has too. Another thread of the leaf may store it,
 * atomically. For an action of this process; a host with 1.1 calls progress. */
#define LOCKSTEP_KEPT_PROGRESS "lockstep.kept_progress"

#ifdef __cplusplus
}
#endif

#endif
