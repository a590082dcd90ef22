/* lockstep/ext/boards.h: blackboard entries by their names. */
#ifndef LOCKSTEP_EXT_BOARDS_H
#define LOCKSTEP_EXT_BOARDS_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The entries of a run by their names, for code that has no port for them. Found with
 * get_extension(LOCKSTEP_BOARDS). A board is a tree's: of the main tree, index 0, and of each use
 * of a SubTree. It is valid until its last user releases it. If its run is over, it has no
 * entries and takes none.
 *
 * Any thread may call these functions at any time. Between lock and unlock only this thread
 * uses the entries; it may lock again within. While leaves do their work no other thread has the
 * lock, so a tick waits for a thread that has it. What read gives is valid until unlock, and each
 * other function locks for its own time only. */
typedef struct lockstep_board lockstep_board;

typedef struct lockstep_entry_value {
  uint32_t struct_size;   /* set by the caller */
  lockstep_type type;     /* of the value; 0: it has none, or an object of another process */
  lockstep_type declared; /* of the entry; LOCKSTEP_ANY: the next value decides */
  bool flag;              /* of LOCKSTEP_BOOL */
  int64_t whole;          /* of LOCKSTEP_INT */
  double number;          /* of LOCKSTEP_DOUBLE */
  const void* items;      /* of a text: UTF-8; of a list: as the get of its type has them */
  size_t count;           /* of items */
  void* object;           /* borrowed; write retains it */
  const lockstep_object_type* object_type; /* of the entry. read gives its name only */
  const char* object_name;                 /* by read: of the entry's objects; NULL: it has none */
  uint64_t writes; /* by read: another one for each value since it was made */
} lockstep_entry_value;

typedef struct lockstep_boards {
  uint32_t struct_size;

  /* [any] Of the tree that the node is in, for whoever releases it. NULL: no type of the run has
   * LOCKSTEP_OPENS, and no program opens entries; or the node is in a separate process. */
  lockstep_board* (*of)(const lockstep_caller* caller);
  /* [any] The board where the entry of a port is at home, and its name there, valid as long as that
   * board; UINT32_MAX: the port is bound to no entry. */
  uint32_t (*of_port)(const lockstep_caller* caller, uint32_t port, const char** name,
                      size_t* length);
  /* Another board of the run, for whoever releases it; NULL: there is none. */
  lockstep_board* (*at)(lockstep_board* board, uint32_t index);
  void (*release)(lockstep_board* board);
  uint32_t (*index)(const lockstep_board* board);
  bool (*is_over)(lockstep_board* board); /* its run has ended */
  /* Of the tree outside; UINT32_MAX: it is the main tree. */
  uint32_t (*parent)(const lockstep_board* board);

  void (*lock)(lockstep_board* board);
  void (*unlock)(lockstep_board* board);
  bool (*try_lock)(lockstep_board* board); /* false: another thread has them */

  /* Where a key is at home: the index of that board, and its name there, valid as long as `key`
   * and the board. */
  uint32_t (*home)(lockstep_board* board, const char* key, size_t length, const char** name,
                   size_t* name_length);
  /* False: there is no such entry now. */
  bool (*read)(lockstep_board* board, const char* key, size_t length, lockstep_entry_value* value);
  /* Makes the entry if there is none, and sets its declared type and its value; without a type of
   * the value, only the declared one. False: the tree gives it another type for good. */
  bool (*write)(lockstep_board* board, const char* key, size_t length,
                const lockstep_entry_value* value);
  /* Removes an entry that is at home on this board. */
  void (*unset)(lockstep_board* board, const char* key, size_t length);
  /* The keys that are at home on this board and have an entry now. */
  void (*each)(lockstep_board* board, void (*visit)(void* user, const char* key, size_t length),
               void* user);
} lockstep_boards;

#define LOCKSTEP_BOARDS "lockstep.boards"

#ifdef __cplusplus
}
#endif

#endif
