/* The types of values of leaf.h whose functions differ in their names only, as a table for C and
 * C++: the code that reads and writes ports or entries is written once for all types.
 *
 *   #define ROW(TYPE, of_type, Item) …
 *   LOCKSTEP_PLAIN_TYPES(ROW)
 *   #undef ROW
 *
 * where LOCKSTEP_TYPE is the type, get_of_type and set_of_type its functions in lockstep_host (in
 * runtime.h, lockstep_run_get_of_type and three more), and Item is what they exchange.
 *
 * A string, an object and a list of strings have functions of another shape. A later version may
 * have more rows. */
#ifndef LOCKSTEP_VALUE_TYPES_H
#define LOCKSTEP_VALUE_TYPES_H

#include <stdbool.h>
#include <stdint.h>

/* One value. */
#define LOCKSTEP_PLAIN_TYPES(ROW) \
  ROW(BOOL, bool, bool)           \
  ROW(INT, int, int64_t)          \
  ROW(DOUBLE, double, double)

/* A list of such values. */
#define LOCKSTEP_LIST_TYPES(ROW)        \
  ROW(DOUBLE_LIST, double_list, double) \
  ROW(INT_LIST, int_list, int64_t)      \
  ROW(BOOL_LIST, bool_list, bool)

#endif
