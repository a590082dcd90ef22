/* lockstep/leaf.h: the contract between lockstep and a plugin of leaves (actions, conditions).
 *
 * A plugin is a shared object that exports a constant lockstep_plugin, `lockstep_plugin_entry`.
 * This header is C99, C11 and C++; C++ authors want lockstep/leaf.hpp, which wraps it.
 *
 * A leaf needs what stands first. What few need has a header each in lockstep/ext/, which this one
 * includes. The marks [load], [run] and [any] name the thread that calls a function. They, and the
 * rules of compatibility, memory and exceptions, stand at the end.
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

/* The result of a tick. Any other number is a fault of the leaf. A condition never runs. */
typedef int32_t lockstep_status;
enum {
  LOCKSTEP_IDLE = 0, /* of a child that is not active. No result of a tick */
  LOCKSTEP_RUNNING = 1,
  LOCKSTEP_SUCCESS = 2,
  LOCKSTEP_FAILURE = 3,
  LOCKSTEP_SKIPPED = 4 /* as if the node were not there in this tick: idle then, and not halted */
};

typedef int32_t lockstep_leaf_kind;
enum {
  LOCKSTEP_ACTION = 1,
  LOCKSTEP_CONDITION = 2,
  LOCKSTEP_CONTROL = 3,  /* has min_children to max_children: lockstep/ext/children.h */
  LOCKSTEP_DECORATOR = 4 /* has one child. All else holds for both as for an action */
};

typedef int32_t lockstep_type;
enum {
  LOCKSTEP_BOOL = 1,        /* "true", "false" */
  LOCKSTEP_INT = 2,         /* 64 bits, signed */
  LOCKSTEP_DOUBLE = 3,      /* finite */
  LOCKSTEP_STRING = 4,      /* UTF-8 */
  LOCKSTEP_DOUBLE_LIST = 5, /* "0.25;0.5" */
  LOCKSTEP_INT_LIST = 6,    /* "1;-2" */
  LOCKSTEP_BOOL_LIST = 7,   /* "true;false" */
  LOCKSTEP_STRING_LIST = 8, /* "front door;back door"; a backslash before ';' or '\\' keeps it */
  LOCKSTEP_OBJECT = 9,      /* carried by reference count: lockstep/ext/object.h */
  LOCKSTEP_NUMBER = 100,    /* of an input: a constant or an entry, int or double */
  LOCKSTEP_ANY = 101        /* any of the above; a constant is a string: lockstep/ext/place.h */
};

typedef int32_t lockstep_direction;
enum { LOCKSTEP_INPUT = 1, LOCKSTEP_OUTPUT = 2, LOCKSTEP_INOUT = 3 };

/* A cut: the process of the run ended without its last halts, by a kill, a crash or a power
 * failure, and another process continues the run. */
typedef struct lockstep_cut {
  uint32_t struct_size;
  bool power;          /* the machine was off too, or has restarted */
  bool held;           /* the leaf got no ticks when it was cut */
  uint8_t on_resume;   /* what the tree wants of a leaf that finds later that it cannot continue:
                          LOCKSTEP_SUCCESS, LOCKSTEP_FAILURE, or 0: that it starts again */
  double gap;          /* seconds by the clock of the wall since the bytes were saved; at least 0 */
  uint64_t lost_ticks; /* at most so many ticks came after the bytes: what the leaf did in them is
                          done, though the run does not know it */
} lockstep_cut;

/* What a leaf does after a cut. Any other number is a fault of the leaf. */
typedef int32_t lockstep_after_cut;
enum {
  LOCKSTEP_STARTS_AGAIN = 0,   /* start is called before its next tick */
  LOCKSTEP_CONTINUES = 1,      /* it runs as before the cut: its progress is what it reports now */
  LOCKSTEP_CANNOT_CONTINUE = 2 /* its next tick would be a failure, and is not called */
};
enum { LOCKSTEP_MOST_KEPT = 65536 }; /* bytes of a leaf */

/* Declared below, and in lockstep/ext/. */
typedef struct lockstep_host lockstep_host;
typedef struct lockstep_object_type lockstep_object_type;
typedef struct lockstep_behavior lockstep_behavior;
typedef struct lockstep_fixed lockstep_fixed;
typedef struct lockstep_refusal lockstep_refusal;

/* A port: an XML attribute of the leaf, constant or bound to a blackboard entry. */
typedef struct lockstep_port {
  uint32_t struct_size; /* sizeof(lockstep_port) as the plugin knew it */
  lockstep_type type;
  lockstep_direction direction;
  const char* name; /* the XML attribute: a letter, then letters, digits, '_', '-', '.', and UTF-8;
                       each port of a leaf has its own; 'name' and 'ID' are taken */
  const char* default_value; /* a constant, as written in XML; NULL: an input or inout must be given
                                in the tree, an output (which has no default) may be left out */
  const char* unit;          /* "s", "m/s"; NULL or "" for none */
  const char* doc;           /* one sentence; NULL for none */

  /* What the host checks for the plugin, in constants when a tree is loaded, in entries when the
   * port is read (get returns false, and the leaf has an error), and in set. */
  const char* choices; /* of a string: the words that it may be, "soft;firm"; NULL for any text */
  double min, max;     /* of numbers, also in lists; both 0 for any, HUGE_VAL for no upper end */
  const lockstep_object_type* object; /* of a LOCKSTEP_OBJECT, which has no default; or NULL */
  uint64_t flags;                     /* LOCKSTEP_OPTIONAL, …: below */
} lockstep_port;

/* The caller: one leaf of one run, or one run (in create_run). Given by the host at create or
 * create_run and valid until destroy or destroy_run returns. Opaque. */
typedef struct lockstep_caller lockstep_caller;

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
  const char* id;      /* the XML tag: a letter, then letters, digits, '_', '-', and UTF-8; no tag
                          of the language */
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
  /* [run] (optional) How much of the activation is done, in [0, 1]. Called only while running,
   * also while paused. Outside [0, 1] is clamped, with a warning; NaN is a fault. It may fall. Of a
   * control node or decorator without this function: the least of its children that run. */
  double (*progress)(void* leaf);
  /* [run] (optional) Called after create: lockstep/ext/kept_progress.h. */
  const void* (*get_extension)(void* leaf, const char* id);

  /* Few types need what follows: 0 or NULL. */
  uint64_t flags;                    /* LOCKSTEP_REAL_TIME, …: below */
  uint32_t min_children;             /* of a control node; 0: one */
  uint32_t max_children;             /* of a control node; 0: any number */
  void (*start_unreset)(void* leaf); /* [run] (optional) lockstep/ext/children.h */
  uint32_t behavior_count;           /* at most 4096 */
  const lockstep_behavior* behavior; /* lockstep/ext/behavior.h */
  const char* more_ports;            /* "goal.*;result.*": lockstep/ext/more_ports.h, as describe */
  const struct lockstep_leaf_type* (*describe)(const lockstep_fixed* fixed, uint32_t count,
                                               lockstep_refusal* why);
  const void* data; /* what the plugin likes: lockstep_place::data */

  /* [run] (optional) Since 1.5. Of an action below a node with pace="true": how fast to be from now
   * on, in (0, 1]; 1 is as fast as the leaf is by itself. Called after start or resume and before
   * tick, only when it has changed, never while paused. Each activation begins with 1, without a
   * call, and the end of an activation ends it, halt included: undo there what a device was told.
   * Returns what the leaf takes up, from factor to 1: its least speed, or 1 where it cannot be
   * slower now. What is less or more is clamped, NaN is a fault. */
  double (*set_pace)(void* leaf, double factor);

  /* [run] (optional, both or none) Since 1.5. Of an action in a run that a checkpoint keeps. save
   * is called after each tick in which the leaf is Running, held or not. It
   * writes what another object needs to go on from here, at most `room` bytes (LOCKSTEP_MOST_KEPT),
   * and returns how many: 0 for nothing, more than `room` is an error. Only copy: the tick waits.
   * restore is called before the first tick after a cut, in place of start, on an object that has
   * not begun, with the bytes of the last save. With cut->held, pause was called before the cut,
   * and resume comes before the next tick: stay where you are. */
  size_t (*save)(void* leaf, void* bytes, size_t room);
  lockstep_after_cut (*restore)(void* leaf, const void* bytes, size_t size,
                                const lockstep_cut* cut);
} lockstep_leaf_type;

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
   * received. The caller is the plugin itself: it has no ports, no time and no random numbers, its
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

  /* [load] (optional) For a plugin that finds out only when it is opened what it has:
   * called before anything else, also by `lockstep check`, which calls no other function. Returns
   * the table that counts in place of this one, of which only the version, the size and describe
   * are looked at; or NULL, and in *why what is wrong. */
  const struct lockstep_plugin* (*describe)(const char** why);
} lockstep_plugin;

#if defined(_WIN32)
#define LOCKSTEP_EXPORT __declspec(dllexport)
#else
#define LOCKSTEP_EXPORT __attribute__((visibility("default")))
#endif

/* The plugin defines it, once: const lockstep_plugin lockstep_plugin_entry = {...}; */
#define LOCKSTEP_PLUGIN_ENTRY "lockstep_plugin_entry"
extern LOCKSTEP_EXPORT const lockstep_plugin lockstep_plugin_entry;

/* A text that is an item of a list. It need not end in a NUL; one that the host hands out does, and
 * length does not count it. */
typedef struct lockstep_text {
  const char* text;
  size_t length;
} lockstep_text;

typedef int32_t lockstep_log_level;
enum { LOCKSTEP_LOG_DEBUG = 0, LOCKSTEP_LOG_INFO = 1, LOCKSTEP_LOG_WARNING = 2 };

/* What the host offers. Valid until the end of the process. */
struct lockstep_host {
  uint32_t abi_major;
  uint32_t abi_minor;
  uint32_t struct_size;
  const char* name;    /* "lockstep" */
  const char* version; /* of the host, "1.2.3" */

  /* [run] Ports, by their index in the leaf type. get returns false and leaves *value unchanged
   * when the port has no value now (no default and an entry that was not written yet, an output),
   * when the index or the type is wrong, or when the caller is a run. A string or list that get
   * hands out belongs to the host and is valid until the next call that sets a port, or until the
   * leaf function returns, whichever is first; a string ends in a NUL that *length does not count.
   * set copies; it returns false and changes nothing when the port is an input, not bound to an
   * entry, or of another type, when a number is not finite, or when there is no memory. No get or
   * set locks; what allocates is a string or list that grows. */
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

  /* [run] Reports that the caller has failed as a program, not as an action: the run ends in order
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

  /* [any] A line for the person that runs the tree. Not a way to report a failure: why an action
   * fails is told with lockstep/ext/reason.h. */
  void (*log)(const lockstep_caller* caller, lockstep_log_level level, const char* message);

  /* [any] A table of functions beyond this one, or NULL when the host does not know the id. */
  const void* (*get_extension)(const char* id);

  /* [run] As get and set above. Of a LOCKSTEP_NUMBER, get_double reads what it is now, and get_int
   * only an int. */
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

  /* [run] Since 1.5 (check struct_size). In place of set_error, where the caller
   * needs the value of a port that has none: the host reports why, "port 'goal' has no value:
   * nothing has written the entry '{goal}'". */
  void (*set_empty_port)(const lockstep_caller* caller, uint32_t port);
};

/* Bits of lockstep_leaf_type::flags. A host ignores those that it does not know. */
enum {
  /* The leaf works in real time, whether ticks come or not: in a thread, with a device. On a
   * virtual clock, where ticks do not wait for it, the host warns of it. */
  LOCKSTEP_REAL_TIME = 1,
  /* A condition that may also return running. */
  LOCKSTEP_MAY_RUN = 2,
  /* The node uses entries that no port names: lockstep_place::open. */
  LOCKSTEP_OPENS = 4,
  /* An action that never returns running. */
  LOCKSTEP_AT_ONCE = 8,
  /* A control node or decorator whose halt is called before its children are halted, and
   * may halt them itself. */
  LOCKSTEP_HALTS_CHILDREN = 16,
  /* The node may want to be ticked before the next period: lockstep_place::wake. */
  LOCKSTEP_WAKES = 32
};

/* Bits of lockstep_port::flags. A host ignores those that it does not know. */
enum {
  /* The tree may leave the port out though it has no default: it has no value then. */
  LOCKSTEP_OPTIONAL = 1,
  /* default_value is "{key}", the entry that the port is bound to where the tree leaves it out;
   * "{=}" is the entry of the port's name. An output may also have such a default. */
  LOCKSTEP_DEFAULT_ENTRY = 2,
  /* The tree gives it a constant, never an entry. lockstep_leaf_type::describe sees it. */
  LOCKSTEP_FIXED = 4
};

/*
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
 * during the call, unless documented otherwise. Neither side frees what the other allocated.
 *
 * Exceptions must not cross: a C++ plugin catches its own. (The host catches what it can.)
 */

#ifdef __cplusplus
}
#endif

#include "ext/behavior.h"      /* IWYU pragma: export */
#include "ext/boards.h"        /* IWYU pragma: export */
#include "ext/children.h"      /* IWYU pragma: export */
#include "ext/kept_progress.h" /* IWYU pragma: export */
#include "ext/lasting.h"       /* IWYU pragma: export */
#include "ext/more_ports.h"    /* IWYU pragma: export */
#include "ext/object.h"        /* IWYU pragma: export */
#include "ext/place.h"         /* IWYU pragma: export */
#include "ext/reason.h"        /* IWYU pragma: export */
#include "ext/words.h"         /* IWYU pragma: export */
#include "ext/workers.h"       /* IWYU pragma: export */

#endif
