/* lockstep/leaf.h: the contract between lockstep and a plugin of leaves (actions, conditions).
 *
 * A plugin is a shared object that exports one symbol, `lockstep_plugin_entry`, a constant
 * `lockstep_plugin`. Everything else is reached from there. This header is C99; it is also valid
 * C11 and C++. C++ authors want lockstep/leaf.hpp, which wraps it.
 *
 * Compatibility. A host loads a plugin whose abi_major equals its own; the minor may be older or
 * newer. Within a major, structs only grow at their end and functions are only added. Every
 * struct begins with its size (or holds it right after the version), so each side reads only what
 * the other wrote: a member beyond the given size is absent. What does not fit is added as an
 * extension, found by a string id.
 *
 * Threads. Marks on functions:
 *   [load]  called by one thread, while no leaf of this plugin exists, or at the very end.
 *   [run]   called by the thread that ticks this run. One run is ticked by one thread at a time;
 *           the leaves of one run are never called at the same time. Other runs of the same plugin
 *           may be ticked by other threads at that moment: what they share must be guarded.
 *           A function of the host with this mark refuses other threads: get and set return false,
 *           set_error does nothing, numbers are 0.
 *   [any]   may be called from any thread, as long as the leaf exists.
 *
 * Memory. Descriptors and every string in them belong to the plugin and stay valid and unchanged
 * until the end of the process. A string passed to a function belongs to the caller and is valid
 * during the call, unless said otherwise. Neither side frees what the other allocated.
 *
 * Exceptions must not cross: a C++ plugin catches its own. (The host catches what it can.)
 */
#ifndef LOCKSTEP_LEAF_H
#define LOCKSTEP_LEAF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LOCKSTEP_ABI_MAJOR 1u
#define LOCKSTEP_ABI_MINOR 5u

#if defined(_WIN32)
#define LOCKSTEP_EXPORT __declspec(dllexport)
#else
#define LOCKSTEP_EXPORT __attribute__((visibility("default")))
#endif

/* The result of a tick. Any other number is a fault of the leaf. A condition never runs. */
typedef int32_t lockstep_status;
enum { LOCKSTEP_RUNNING = 1, LOCKSTEP_SUCCESS = 2, LOCKSTEP_FAILURE = 3 };
/* Since 1.1: as if the node were not there in this tick. It is idle then, and is not halted. */
enum { LOCKSTEP_SKIPPED = 4 };
/* Since 1.1: of a child that is not active. No result of a tick. */
enum { LOCKSTEP_IDLE = 0 };

/* The kind of a node type. Control nodes and decorators (since 1.1) have children in the tree and
 * tick them with the functions of lockstep_children; all else holds for them as for an action. */
typedef int32_t lockstep_leaf_kind;
enum {
  LOCKSTEP_ACTION = 1,
  LOCKSTEP_CONDITION = 2,
  LOCKSTEP_CONTROL = 3,  /* has min_children to max_children */
  LOCKSTEP_DECORATOR = 4 /* has one child */
};

/* Bits of lockstep_leaf_type::flags. A host ignores those that it does not know. */
enum {
  /* The leaf works in real time, whether ticks come or not: in a thread, with a device. On a
   * virtual clock, where ticks do not wait for it, the host warns of it. */
  LOCKSTEP_REAL_TIME = 1,
  /* Since 1.1: a condition that may also return running. */
  LOCKSTEP_MAY_RUN = 2,
  /* Since 1.1: the node uses entries that no port names: lockstep_place::open. */
  LOCKSTEP_OPENS = 4,
  /* Since 1.1: an action that never returns running. */
  LOCKSTEP_AT_ONCE = 8,
  /* Since 1.1: a control node or decorator whose halt is called before its children are halted, and
   * may halt them itself. */
  LOCKSTEP_HALTS_CHILDREN = 16,
  /* Since 1.3: the node may want to be ticked before the next period: lockstep_place::wake. */
  LOCKSTEP_WAKES = 32
};

typedef int32_t lockstep_type;
enum {
  LOCKSTEP_BOOL = 1,        /* "true", "false" */
  LOCKSTEP_INT = 2,         /* 64 bits, signed */
  LOCKSTEP_DOUBLE = 3,      /* finite */
  LOCKSTEP_STRING = 4,      /* UTF-8 */
  LOCKSTEP_DOUBLE_LIST = 5, /* "0.25;0.5" */
  /* Since 1.1. */
  LOCKSTEP_INT_LIST = 6,    /* "1;-2" */
  LOCKSTEP_BOOL_LIST = 7,   /* "true;false" */
  LOCKSTEP_STRING_LIST = 8, /* "front door;back door"; a backslash before ';' or '\\' keeps it */
  LOCKSTEP_OBJECT = 9,      /* carried by reference count: lockstep_object_type */
  LOCKSTEP_NUMBER = 100,    /* of an input: a constant or an entry, int or double */
  LOCKSTEP_ANY = 101        /* any of the above; a constant is a string: lockstep_place */
};

/* A text that is an item of a list. It need not end in a NUL; one that the host hands out does, and
 * length does not count it. */
typedef struct lockstep_text {
  const char* text;
  size_t length;
} lockstep_text;

typedef int32_t lockstep_direction;
enum { LOCKSTEP_INPUT = 1, LOCKSTEP_OUTPUT = 2, LOCKSTEP_INOUT = 3 };

typedef int32_t lockstep_log_level;
enum { LOCKSTEP_LOG_DEBUG = 0, LOCKSTEP_LOG_INFO = 1, LOCKSTEP_LOG_WARNING = 2 };

/* Since 1.1: a type of objects that ports carry by reference. What is carried does not change. Two
 * types of one name are one, also of different plugins: each may get what the other has made, so
 * the name says how the object looks in memory. Declare each type once in a plugin. */
typedef struct lockstep_object_type {
  uint32_t struct_size; /* sizeof(lockstep_object_type) as the plugin knew it */
  const char* name;     /* "nav.Path": up to 100 letters, digits and '._:/-'; inside also blanks and
                           '<>,*&()[]', as in the name of a C++ type */

  /* [any] One reference more; one less, and with the last the end of the object. A reference that a
   * leaf has set is released in a function of the run, at the latest before destroy_run. */
  void (*retain)(void* object);
  void (*release)(void* object);

  /* [any] (optional) For recordings and views: writes at most `size` bytes of the text, without a
   * NUL, and returns how many bytes the whole text has. */
  size_t (*to_text)(const void* object, char* text, size_t size);
  /* [any] (optional) For constants in a tree: a new object with one reference, or NULL when the
   * text is none. It must not need init: `lockstep check` calls it too. Such an object belongs to
   * the tree, whose runs share it, and is released when the tree is. */
  void* (*from_text)(const char* text, size_t length);

  /* [any] (optional, both or none) For plugins in separate processes, which exchange bytes. Writes
   * at most `size` bytes and returns how many the whole object has, at most 64 MiB; SIZE_MAX when
   * it cannot tell. */
  size_t (*to_bytes)(const void* object, void* bytes, size_t size);
  /* A new object with one reference, or NULL when the bytes are none. Another process has written
   * them, which may run another version of the plugin: check them. */
  void* (*from_bytes)(const void* bytes, size_t length);

  /* [any] (optional) Why the last from_text of this thread returned NULL, in a sentence; NULL when
   * there is no more to say. Valid until the next from_text. */
  const char* (*why_no_object)(void);

  /* (optional) Since 1.3: whether an input of this type may be bound to an entry of the type of
   * that name. The leaf gets such an object by lockstep_place::get_object, with that type, and
   * makes of it what it needs. */
  bool (*reads)(const char* name);
} lockstep_object_type;

/* Bits of lockstep_port::flags, since 1.1. A host ignores those that it does not know. */
enum {
  /* The tree may leave the port out though it has no default: it has no value then. */
  LOCKSTEP_OPTIONAL = 1,
  /* default_value is "{key}", the entry that the port is bound to where the tree leaves it out;
   * "{=}" is the entry of the port's name. An output may have such a default, too. */
  LOCKSTEP_DEFAULT_ENTRY = 2,
  /* Since 1.4: the tree gives it a constant, never an entry. lockstep_leaf_type::describe sees it.
   */
  LOCKSTEP_FIXED = 4
};

/* A port: an XML attribute of the leaf, constant or bound to a blackboard entry. */
typedef struct lockstep_port {
  uint32_t struct_size; /* sizeof(lockstep_port) as the plugin knew it */
  lockstep_type type;
  lockstep_direction direction;
  const char* name; /* the XML attribute: a letter, then letters, digits, '_' (since 1.1 also
                       '-' and UTF-8, since 1.4 also '.'); each port of a leaf has its own; 'name'
                       and 'ID' are taken */
  const char* default_value; /* a constant, as written in XML; NULL: an input or inout must be given
                                in the tree, an output (which has no default) may be left out */
  const char* unit;          /* "s", "m/s"; NULL or "" for none */
  const char* doc;           /* one sentence; NULL for none */

  /* Since 1.1: what the host checks for the plugin, in constants when a tree is loaded, in entries
   * when the port is read (get returns false, and the leaf has an error), and in set. */
  const char* choices; /* of a string: the words that it may be, "soft;firm"; NULL for any text */
  double min, max;     /* of numbers, also in lists; both 0 for any, HUGE_VAL for no upper end */
  const lockstep_object_type* object; /* of a LOCKSTEP_OBJECT, which has no default; else NULL */
  uint64_t flags;
} lockstep_port;

/* Who is calling: one leaf of one run, or one run (in create_run). Given by the host at create or
 * create_run and valid until destroy or destroy_run returns. Opaque. */
typedef struct lockstep_caller lockstep_caller;

/* What the host offers. Valid until the end of the process. */
typedef struct lockstep_host {
  uint32_t abi_major;
  uint32_t abi_minor;
  uint32_t struct_size;
  const char* name;    /* "lockstep" */
  const char* version; /* of the host, "1.2.3" */

  /* [run] Ports, by their index in the leaf type. get returns false and leaves *value unchanged
   * when the port has no value now (no default and an entry nobody wrote yet, an output), when
   * the index or the type is wrong, or when the caller is a run. A string or list that get hands
   * out belongs to the host and is valid until the next call that sets a port, or until the leaf
   * function returns, whichever is first; a string ends in a NUL that *length does not count. set
   * copies; it returns false and changes nothing when the port is an input, not bound to an entry,
   * or of another type, when a number is not finite, or when there is no memory. No get or set
   * locks; what allocates is a string or list that grows. */
  bool (*get_bool)(const lockstep_caller* caller, uint32_t port, bool* value);
  bool (*get_int)(const lockstep_caller* caller, uint32_t port, int64_t* value);
  bool (*get_double)(const lockstep_caller* caller, uint32_t port, double* value);
  bool (*get_string)(const lockstep_caller* caller, uint32_t port, const char** text,
                     size_t* length);
  bool (*get_double_list)(const lockstep_caller* caller, uint32_t port, const double** values,
                          size_t* count);
  bool (*set_bool)(const lockstep_caller* caller, uint32_t port, bool value);
  bool (*set_int)(const lockstep_caller* caller, uint32_t port, int64_t value);
  bool (*set_double)(const lockstep_caller* caller, uint32_t port, double value);
  bool (*set_string)(const lockstep_caller* caller, uint32_t port, const char* text, size_t length);
  bool (*set_double_list)(const lockstep_caller* caller, uint32_t port, const double* values,
                          size_t count);

  /* [run] Says that the caller has failed as a program, not as an action: the run ends in order
   * with `message` as the reason. To be called inside a function of the leaf, which then returns
   * as usual; its result does not count. The first message of a call is kept: its first 500 bytes
   * are copied, the rest is counted. */
  void (*set_error)(const lockstep_caller* caller, const char* message);

  /* [run] Seconds since the run began, the same for the whole of a tick. */
  double (*now)(const lockstep_caller* caller);
  /* [run] Seconds between two ticks, as set for the run. */
  double (*tick_period)(const lockstep_caller* caller);

  /* [run] The caller's own stream of random numbers: 64 random bits, or uniform in [0, 1). The
   * same seed, tree and run give the same numbers. */
  uint64_t (*random_bits)(const lockstep_caller* caller);
  double (*random)(const lockstep_caller* caller);

  /* [any] A line for the person who runs the tree. Not a way to report a failure. */
  void (*log)(const lockstep_caller* caller, lockstep_log_level level, const char* message);

  /* [any] A table of functions beyond this one, or NULL when the host does not know the id. */
  const void* (*get_extension)(const char* id);

  /* [run] Since 1.1, as get and set above: a host that loads a leaf with a port of such a type has
   * them. Of a LOCKSTEP_NUMBER, get_double reads what it is now, and get_int only an int. */
  bool (*get_int_list)(const lockstep_caller* caller, uint32_t port, const int64_t** values,
                       size_t* count);
  bool (*get_bool_list)(const lockstep_caller* caller, uint32_t port, const bool** values,
                        size_t* count);
  bool (*get_string_list)(const lockstep_caller* caller, uint32_t port,
                          const lockstep_text** values, size_t* count);
  bool (*set_int_list)(const lockstep_caller* caller, uint32_t port, const int64_t* values,
                       size_t count);
  bool (*set_bool_list)(const lockstep_caller* caller, uint32_t port, const bool* values,
                        size_t count);
  bool (*set_string_list)(const lockstep_caller* caller, uint32_t port, const lockstep_text* values,
                          size_t count);
  /* The object that get hands out is borrowed: retain it to keep it. set retains it for the entry;
   * NULL is no object. */
  bool (*get_object)(const lockstep_caller* caller, uint32_t port, void** object);
  bool (*set_object)(const lockstep_caller* caller, uint32_t port, void* object);
} lockstep_host;

/* Since 1.1: what a control node or decorator does with its children, which it names by index, from
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
 * LOCKSTEP_HALTS_CHILDREN, after its halt. A child that runs and is not ticked goes on by itself,
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
   * does not begin again: it is told by start_unreset in place of start. An action that takes time
   * and has no start_unreset is not ticked; it gives the same result. */
  lockstep_status (*tick_unreset)(const lockstep_caller* caller, uint32_t child);
} lockstep_children;

#define LOCKSTEP_CHILDREN "lockstep.children"

/* Since 1.1: threads of leaves on the virtual clock, where time jumps from tick to tick. Such a
 * thread is a worker: it takes turns with the ticks and with other workers, so that a run is the
 * same every time. In its turn it may do what it likes, but the run waits for it. Its turn ends
 * when it waits for a time of the run, or ends. Found with get_extension(LOCKSTEP_WORKERS).
 *
 * A worker has a turn in the first tick at or after the time that it waits for, and one at the end
 * of the tick in which it began or was woken. Workers have their turns in the order in which they
 * began. A worker must not wait for another one by other means. */
typedef struct lockstep_worker lockstep_worker;
typedef struct lockstep_workers {
  uint32_t struct_size;

  /* [run] A new worker of the leaf. NULL when the run is not on the virtual clock, where threads
   * work in real time, as they like; and after an error. Valid until finish returns. */
  lockstep_worker* (*begin)(const lockstep_caller* caller);
  /* [run] Gives the worker turns until it has ended. Each worker is to be finished. */
  void (*finish)(lockstep_worker* worker);

  /* The next four: by the thread that is the worker. */
  /* Its first call: waits for the first turn. */
  void (*start)(lockstep_worker* worker);
  /* Ends the turn. Returns true when it is `until`, in seconds since the run began; false when it
   * was woken before. Infinity: until it is woken. */
  bool (*wait)(lockstep_worker* worker, double until);
  /* Its last call. */
  void (*end)(lockstep_worker* worker);
  /* Seconds since the run began; stands still within a turn. */
  double (*now)(lockstep_worker* worker);

  /* [any] Ends the wait, at its next turn. */
  void (*wake)(lockstep_worker* worker);
} lockstep_workers;

#define LOCKSTEP_WORKERS "lockstep.workers"

/* Since 1.1: what a node may know about its place in the tree, and ports of type LOCKSTEP_ANY.
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

  /* [run] In tick: where the tree is in a language whose nodes ask for it, it is ticked once more
   * in this period if its root runs then. */
  void (*ask_for_tick)(const lockstep_caller* caller);

  /* Since 1.3 (struct_size says whether it is there). [any] The tree is ticked at once, by who
   * waits for its next period, or right after the tick that goes on. Only for a type with
   * LOCKSTEP_WAKES. Nothing happens on the virtual clock, where a period takes no time, and in a
   * separate process. It never waits. */
  void (*wake)(const lockstep_caller* caller);

  /* Since 1.4. [any] lockstep_leaf_type::data of the node's type: of the one that describe returned
   * for its element. */
  const void* (*data)(const lockstep_caller* caller);

  /* Since 1.5. [any] The language of the tree, by the attribute of its root: "lockstep" or
   * "BTCPP_format". In the second one a child may be ticked again in the same tick, and a parent
   * resets its children: start_unreset. NULL: in a separate process, which has no control nodes. */
  const char* (*language)(const lockstep_caller* caller);
} lockstep_place;

#define LOCKSTEP_PLACE "lockstep.place"

/* Since 1.3: the entries of a run by their names, for code that has no port for them. Found with
 * get_extension(LOCKSTEP_BOARDS). A board is a tree's: of the main tree, index 0, and of each use
 * of a SubTree. It is valid as long as somebody has it, and its run may be over: then it has no
 * entries and takes none.
 *
 * Any thread may call these functions at any time. Between lock and unlock the thread has the
 * entries for itself, and as often as it likes; while leaves do their work nobody has them, so a
 * tick waits for whoever does. What read gives is valid until unlock, and each other function locks
 * for its own time only. */
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

/* Since 1.3: what stays as it is as long as a leaf is there, for one that uses it often: it reads
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

/* Since 1.3: one statement about what an action or a condition does, in the words of a leaf file:
 * {"ticks", "2..40"}. The words are result, ticks, ends, progress, step, finish, held, writes and
 * out.PORT, each at most once; docs/verify.md says what they mean. `lockstep verify` relies on them
 * where no leaf file says otherwise. */
typedef struct lockstep_behavior {
  const char* word;
  const char* value;
} lockstep_behavior;

/* Since 1.4: what an element gives to a port with LOCKSTEP_FIXED, or the port's default. */
typedef struct lockstep_fixed {
  const char* port;
  const char* text;
} lockstep_fixed;

/* Since 1.4: why an element has no type. The texts are valid until the thread calls describe again;
 * the host has set all to NULL, and struct_size. */
typedef struct lockstep_refusal {
  uint32_t struct_size;
  const char* port;    /* whose text is to blame; NULL: the element as a whole */
  const char* message; /* lower case, names in single quotes, no full stop */
  const char* hint;    /* what to do; NULL for none */
} lockstep_refusal;

/* A type of leaf. Functions marked (optional) may be NULL.
 *
 * An activation: start, then tick once per tick of the tree until it returns success, failure or
 * skipped; or halt, when the tree moves on first. Then, perhaps, start again, on the same object.
 * pause is called when a synchronized node begins to withhold ticks from a running leaf, resume
 * just before the next tick; halt may come while paused. When start sets an error, tick and halt do
 * not follow; after an error in tick, pause, resume or progress, halt does. Every function must
 * return quickly: all leaves of a run share its tick. */
typedef struct lockstep_leaf_type {
  uint32_t struct_size; /* sizeof(lockstep_leaf_type) as the plugin knew it */
  lockstep_leaf_kind kind;
  const char* id;      /* the XML tag: a letter, then letters, digits, '_' (since 1.1 also '-' and
                          UTF-8);      no tag of the language */
  const char* doc;     /* one or two sentences; NULL for none */
  uint32_t port_count; /* at most 4096 */
  const lockstep_port* const* ports; /* port_count pointers, none NULL */

  /* [run] A new leaf for one node of one run, or NULL after set_error. run_context is what
   * create_run returned, or NULL. What is returned in spite of an error is destroyed. */
  void* (*create)(const lockstep_host* host, const lockstep_caller* caller, void* run_context);
  /* [run] The end of the leaf; it is not running. */
  void (*destroy)(void* leaf);
  /* [run] (optional) The first tick of an activation is about to come. */
  void (*start)(void* leaf);
  /* [run] */
  lockstep_status (*tick)(void* leaf);
  /* [run] (optional) Stop now: the activation ends here. */
  void (*halt)(void* leaf);
  /* [run] (optional) Hold still, keep the position; ticks stop coming for a while. */
  void (*pause)(void* leaf);
  /* [run] (optional) Ticks come again. */
  void (*resume)(void* leaf);
  /* [run] (optional) How much of the activation is done, in [0, 1]. Asked only while running,
   * also while paused. Outside [0, 1] is clamped, with a warning; NaN is a fault. It may fall. Of a
   * control node or decorator without this function: the least of its children that run. */
  double (*progress)(void* leaf);
  /* [run] (optional) Called after create: LOCKSTEP_KEPT_PROGRESS. NULL: the leaf does not have it.
   */
  const void* (*get_extension)(void* leaf, const char* id);

  /* Since 1.1. */
  uint64_t flags;
  uint32_t min_children; /* of a control node; 0: one */
  uint32_t max_children; /* of a control node; 0: any number */
  /* [run] (optional) In place of start, when the node has completed and its parent ticks it again
   * by tick_unreset: it goes on from its last result. */
  void (*start_unreset)(void* leaf);

  /* Since 1.3. */
  uint32_t behavior_count; /* at most 4096; 0: the type says nothing about what it does */
  const lockstep_behavior* behavior;

  /* Since 1.4: ports by pattern. An element may have more ports than those above: which ones is
   * found out when a tree is loaded, by what it gives to the ports with LOCKSTEP_FIXED. */
  const char*
      more_ports; /* the names that they may have, "goal.*;result.*"; NULL: there are none */
  /* [any] (optional; with more_ports) The type of an element with these constants, `count` of them:
   * of the same id and kind, with all its ports, the fixed ones among them, and without describe.
   * The same constants give the same type, which is valid until the end of the process. NULL: there
   * is none, and why. `lockstep check` and editors call it too, before init. */
  const struct lockstep_leaf_type* (*describe)(const lockstep_fixed* fixed, uint32_t count,
                                               lockstep_refusal* why);
  const void* data; /* what the plugin likes: lockstep_place::data */
} lockstep_leaf_type;

/* Since 1.2: where a leaf keeps its progress, for one that has it as a number: a const double *,
 * from lockstep_leaf_type::get_extension, valid until destroy. The host may read the number
 * wherever it would call progress, which the leaf has too. Another thread of the leaf may store it,
 * atomically. For an action of this process; a host with 1.1 calls progress. */
#define LOCKSTEP_KEPT_PROGRESS "lockstep.kept_progress"

/* Since 1.1: words of a plugin that scripts know as numbers, in trees for BehaviorTree.CPP. Found
 * with lockstep_plugin::get_extension(LOCKSTEP_WORDS), which `lockstep check` calls too; not of a
 * plugin in a separate process. Both lists are valid until the end of the process. */
typedef struct lockstep_words {
  uint32_t struct_size;
  uint32_t count;
  const char* const* words;
  const double* numbers;
} lockstep_words;

#define LOCKSTEP_WORDS "lockstep.words"

typedef struct lockstep_plugin {
  uint32_t abi_major;       /* LOCKSTEP_ABI_MAJOR */
  uint32_t abi_minor;       /* LOCKSTEP_ABI_MINOR */
  uint32_t struct_size;     /* sizeof(lockstep_plugin) as the plugin knew it */
  const char* name;         /* as in <plugin name="..."/>: letters, digits, '_', '-' */
  const char* version;      /* of the plugin; NULL for none */
  const char* doc;          /* one sentence; NULL for none */
  uint32_t leaf_type_count; /* at most 4096 */
  const lockstep_leaf_type* const* leaf_types; /* leaf_type_count pointers, none NULL */

  /* [load] (optional) Before the first leaf; false refuses to work, with the reason that set_error
   * was told. The caller is the plugin itself: it has no ports, no time and no random numbers, its
   * log is not shown, and it is valid until init returns. Not called again unless deinit came in
   * between. Listing the descriptors (`lockstep nodes`, `lockstep check`) does not call it. */
  bool (*init)(const lockstep_host* host, const lockstep_caller* caller);
  /* [load] (optional) After the last leaf, if init returned true (or is NULL). */
  void (*deinit)(void);

  /* [run] (optional, both or none) What the leaves of one run share, such as a simulated world.
   * NULL from create_run is a legal context unless set_error was called; destroy_run gets it too,
   * after the run's last leaf was destroyed. */
  void* (*create_run)(const lockstep_host* host, const lockstep_caller* caller);
  void (*destroy_run)(void* run_context);

  /* [any] (optional) */
  const void* (*get_extension)(const char* id);

  /* Since 1.1. [load] (optional) For a plugin that finds out only when it is opened what it has:
   * called before anything else, also by `lockstep check`, which calls no other function. Returns
   * the table that counts in place of this one, of which only the version, the size and describe
   * are looked at; or NULL, and in *why what is wrong. */
  const struct lockstep_plugin* (*describe)(const char** why);
} lockstep_plugin;

/* The plugin defines it, once: const lockstep_plugin lockstep_plugin_entry = {...}; */
#define LOCKSTEP_PLUGIN_ENTRY "lockstep_plugin_entry"
extern LOCKSTEP_EXPORT const lockstep_plugin lockstep_plugin_entry;

#ifdef __cplusplus
}
#endif

#endif
