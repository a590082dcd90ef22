/* lockstep/runtime.h: lockstep inside a program. Loads a tree, and ticks runs of it at the times
 * that the program gives, or in lockstep's fixed-rate loop. C++ programs want lockstep/runtime.hpp,
 * which wraps it; docs/embedding.md is the manual.
 *
 * Compatibility. This interface only grows: a program that was built with an older header of the
 * same major continues to work. Every struct begins with its size, which the program sets; members
 * beyond it are neither read nor written.
 *
 * Threads. A project belongs to one thread until it has been loaded. After that it does not change
 * any more, and runs of it may be made and used in several threads. One run is used by one thread
 * at a time.
 *
 * Processes. A run belongs to the process that has made it. In a child of fork, lockstep_run_free
 * and lockstep_project_free leave it alone, whoever calls them, and all else but reading and
 * writing entries is refused. The child may make runs of a project that was loaded before, if none
 * of its plugins is isolated or a program.
 *
 * Errors. A function that fails returns false or NULL, and lockstep_last_error() has the reason.
 * What is wrong with a tree is a list of diagnostics of its project. Nothing here prints, installs
 * signal handlers, changes malloc or ends the process. No exception comes out of it.
 *
 * Strings that are passed in are copied. Strings that come out belong to lockstep; each function
 * names how long they are valid. All text is UTF-8 and ends in a NUL: what is passed in and is not
 * UTF-8 is refused, but for the names of files, which are what the system has, and the text of a
 * tree, whose encoding is among its diagnostics. A reason in lockstep_last_error() has 2 KB at
 * most.
 */
#ifndef LOCKSTEP_RUNTIME_H
#define LOCKSTEP_RUNTIME_H

#include <lockstep/leaf.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LOCKSTEP_RUNTIME_MAJOR 1u
#define LOCKSTEP_RUNTIME_MINOR 5u

/* The library's own (major << 16 | minor), which may be newer than the header's. */
LOCKSTEP_EXPORT uint32_t lockstep_runtime_version(void);
/* Why the last call of this thread failed; "" when it did not. Questions that cannot fail, as
 * lockstep_run_fault and the counts, leave it as it is. Valid until the next call. */
LOCKSTEP_EXPORT const char* lockstep_last_error(void);

/* ---- Projects: a tree file, its includes and plugins -------------------------------------------
 */

typedef struct lockstep_project lockstep_project;

LOCKSTEP_EXPORT lockstep_project* lockstep_project_new(void);
/* NULL is allowed. Its runs may live on. */
LOCKSTEP_EXPORT void lockstep_project_free(lockstep_project* project);

/* What it is loaded with. Each of these before loading. */

/* A directory in which plugins are searched; LOCKSTEP_PLUGIN_PATH is searched after those. */
LOCKSTEP_EXPORT bool lockstep_project_add_plugin_path(lockstep_project* project,
                                                      const char* directory);
/* A plugin that no tree names: a file, or a name to search for. */
LOCKSTEP_EXPORT bool lockstep_project_add_plugin(lockstep_project* project, const char* plugin);
/* Leaves that are in the program. The table, and all that it points to, stays valid and unchanged
 * as long as the project and its runs. */
LOCKSTEP_EXPORT bool lockstep_project_add_leaves(lockstep_project* project,
                                                 const lockstep_plugin* plugin);
/* The value of an <arg>. */
LOCKSTEP_EXPORT bool lockstep_project_set_argument(lockstep_project* project, const char* name,
                                                   const char* value);
/* The start value of a blackboard entry, written as in XML. */
LOCKSTEP_EXPORT bool lockstep_project_set_value(lockstep_project* project, const char* key,
                                                const char* value);
/* Which <BehaviorTree>; without it main_tree_to_execute, or the only one. */
LOCKSTEP_EXPORT bool lockstep_project_set_main_tree(lockstep_project* project, const char* id);
/* Runs every plugin in a separate process, not only those for which the tree has isolate. Leaves
 * that are in the program stay there. */
LOCKSTEP_EXPORT bool lockstep_project_isolate_all(lockstep_project* project);
/* The program uses entries by their names, at any time and in any thread, also those
 * that no node of the tree names: lockstep_run_board. Each tick locks the entries then. With
 * has_outside, {@key} in a tree for BehaviorTree.CPP is the entry "@key" of the main board, which
 * the program exchanges with a board outside; otherwise it is the entry "key". */
LOCKSTEP_EXPORT bool lockstep_project_open_entries(lockstep_project* project, bool has_outside);

/* Keeps what lockstep_run_groot2 shows of the tree. */
LOCKSTEP_EXPORT bool lockstep_project_show_groot2(lockstep_project* project);

/* For tests of trees: all leaves of plugins, also of such as are not there, play
 * scripts. No plugin is called. A leaf without a script runs indefinitely; a condition without one
 * fails. */
LOCKSTEP_EXPORT bool lockstep_project_play_leaves(lockstep_project* project);
/* After loading: what a leaf does in runs that are made or restarted from then on, tick
 * by tick: "R0.25 R0.5 S" (docs/verify.md has the words; the last one stays). `path` is its path,
 * in which * stands for any part, so several leaves may have it; a later call wins.
 * `in_each_activation`: it begins with the first word whenever it starts. Not while a run of the
 * project is used in another thread. */
LOCKSTEP_EXPORT bool lockstep_project_play(lockstep_project* project, const char* path,
                                           const char* words, bool in_each_activation);

/* Loads the tree, once. False when there are errors; the diagnostics have them, and warnings too
 * when there are none. */
LOCKSTEP_EXPORT bool lockstep_project_load_file(lockstep_project* project, const char* path);
/* The same from a text. `name` stands for its file in diagnostics, and includes are relative to
 * it. */
LOCKSTEP_EXPORT bool lockstep_project_load_text(lockstep_project* project, const char* name,
                                                const char* text, size_t length);

enum { LOCKSTEP_ERROR = 0, LOCKSTEP_WARNING = 1, LOCKSTEP_NOTE = 2 };

/* Strings are valid as long as the project. */
typedef struct lockstep_diagnostic {
  uint32_t struct_size; /* set by the program */
  int32_t severity;
  const char* file; /* "" when it is about no file */
  uint32_t line;    /* from 1; 0 for the file as a whole */
  uint32_t column;  /* from 1, in bytes */
  const char* message;
  const char* hint; /* what to do, or "" */
} lockstep_diagnostic;

LOCKSTEP_EXPORT uint32_t lockstep_project_diagnostic_count(const lockstep_project* project);
LOCKSTEP_EXPORT bool lockstep_project_diagnostic(const lockstep_project* project, uint32_t index,
                                                 lockstep_diagnostic* diagnostic);

/* The nodes of the tree in pre-order, subtrees expanded; the root is node 0. Strings are valid as
 * long as the project. */
typedef struct lockstep_node {
  uint32_t struct_size; /* set by the program */
  uint32_t parent;      /* the root is its own */
  uint32_t end;         /* one past its last descendant */
  const char* path;     /* "Main/pull/arm" */
  const char* name;     /* "arm"; without a name in the tree, its id */
  const char* id;       /* the tag: "MoveArm" */
} lockstep_node;

/* 0 before it was loaded. */
LOCKSTEP_EXPORT uint32_t lockstep_project_node_count(const lockstep_project* project);
LOCKSTEP_EXPORT bool lockstep_project_node(const lockstep_project* project, uint32_t index,
                                           lockstep_node* node);
LOCKSTEP_EXPORT bool lockstep_project_find_node(const lockstep_project* project, const char* path,
                                                uint32_t* index);

/* The blackboard entries that nodes of the tree use. Strings are valid as long as the
 * project. */
typedef struct lockstep_entry {
  uint32_t struct_size;  /* set by the program */
  lockstep_type type;    /* LOCKSTEP_ANY: nothing declares one */
  const char* key;       /* "height", or "Deliver/height" in a SubTree */
  const char* type_name; /* "double", "list of int", "nav.Path" */
} lockstep_entry;

/* 0 before it was loaded. */
LOCKSTEP_EXPORT uint32_t lockstep_project_entry_count(const lockstep_project* project);
LOCKSTEP_EXPORT bool lockstep_project_entry(const lockstep_project* project, uint32_t index,
                                            lockstep_entry* entry);
/* The index of the entry with this key, a search among all entries. It is the handle of
 * the entry in all runs of this project, as long as one of these runs lives, and in any thread. */
LOCKSTEP_EXPORT bool lockstep_project_find_entry(const lockstep_project* project, const char* key,
                                                 uint32_t* index);

/* ---- Runs --------------------------------------------------------------------------------------
 */

typedef struct lockstep_run lockstep_run;

/* What a fault of a leaf (it throws, returns a wrong status, …) does. */
enum {
  LOCKSTEP_ON_FAULT_STOP = 0, /* the run ends */
  LOCKSTEP_ON_FAULT_FAIL = 1  /* the leaf fails, and the run continues */
};

typedef struct lockstep_run_options {
  uint32_t struct_size; /* set by the program; all else may be 0 */
  int32_t on_fault;
  uint64_t seed;      /* of the leaves' random numbers */
  double tick_period; /* what leaves see as such, in seconds; 0: 0.01 */
  /* The times of ticks are not real: a tick waits for the threads of leaves, which sleep in the
   * run's time. The loop on the virtual clock needs it. */
  bool virtual_time;
  /* A line that a leaf logs; from any thread. Also what the run reports about a leaf:
   * that it reported a progress outside [0, 1], or that it failed and the run continues. */
  void (*log)(void* user, const char* who, lockstep_log_level level, const char* message);
  void* user; /* also of what follows */
  /* Called before leaves are created, also by a restart: may give entries their first
   * values. `main` is the board of the main tree, for the time of the call. May be NULL. */
  void (*prepare)(void* user, lockstep_board* main);
  /* A leaf wants a tick before the next period; from any thread. A program that waits in
   * its own loop ends that wait. It must not call the run, but for lockstep_run_wake. */
  void (*wake)(void* user);
  /* In seconds, 0: none. A call of a leaf that takes longer is reported with the lines
   * that leaves log, at most once a second. */
  double tick_budget;
  /* In seconds, 0: none. `hang` is reported once for a call of a leaf that lasts longer
   * and has not returned: which leaf ("'Main/arm' (Reach of plugin 'arm')"), in which function, for
   * how long. It is called in another thread, and must not call the run; the call continues. A
   * thread that has ticked does not end before another one ticks, or the run is freed. */
  double hang_limit;
  void (*hang)(void* user, const char* who, const char* function, double seconds);
} lockstep_run_options;

/* A new run, whose leaves are created. NULL when a leaf cannot be. `options` may be NULL. */
LOCKSTEP_EXPORT lockstep_run* lockstep_run_new(lockstep_project* project,
                                               const lockstep_run_options* options);
/* Halts what runs, then destroys the leaves. NULL is allowed. */
LOCKSTEP_EXPORT void lockstep_run_free(lockstep_run* run);
/* Begins again, as a new run with this seed would; much faster than that. */
LOCKSTEP_EXPORT bool lockstep_run_restart(lockstep_run* run, uint64_t seed);

/* One tick of the tree. `seconds` is the time since the run began, which must not decrease; time
 * stays the same within a tick. Returns LOCKSTEP_RUNNING also after a fault, when nothing is ticked
 * any more: see lockstep_run_fault. And it does when nothing was ticked, since the time is before
 * that of the last tick (a recording that begins again), negative or no number: then
 * lockstep_last_error is not "". A loop checks both after each tick. After Success or Failure the
 * next tick begins the tree again.
 */
LOCKSTEP_EXPORT lockstep_status lockstep_run_tick(lockstep_run* run, double seconds);
/* The same, but the root is ticked exactly once, also when a node requests another tick
 * at once. */
LOCKSTEP_EXPORT lockstep_status lockstep_run_tick_once(lockstep_run* run, double seconds);
/* Halts every leaf that runs, in the order of the tree. Refused, with lockstep_last_error, in what
 * the run calls back, as lockstep_run_tick, _restart, _loop and _free are. */
LOCKSTEP_EXPORT void lockstep_run_halt(lockstep_run* run);

/* What ended the run ("Main/arm: threw an exception: …"), and the node; NULL when nothing did.
 * `node` may be NULL. Valid until the next call for this run. */
LOCKSTEP_EXPORT const char* lockstep_run_fault(lockstep_run* run, uint32_t* node);

/* After a fault, halts what runs. The run continues: the next tick begins the tree, with
 * the entries and the leaves as they are. The fault is reported with what leaves log, and so is in
 * a recording. False: a leaf could not be created; only lockstep_run_restart is of use then. */
LOCKSTEP_EXPORT bool lockstep_run_recover(lockstep_run* run);

typedef struct lockstep_node_state {
  uint32_t struct_size; /* set by the program */
  lockstep_status status;
  double progress; /* in [0, 1] */
  bool held;       /* ticks are withheld by a synchronized node */
  bool ticked;     /* in the last tick */
} lockstep_node_state;

/* Progress is read from the leaves. */
LOCKSTEP_EXPORT bool lockstep_run_node(lockstep_run* run, uint32_t node,
                                       lockstep_node_state* state);

/* What a node asks a person at this moment: the text of its question, valid until the next call for
 * this run; NULL when it asks nothing. And the answer to it, one of the options of the node,
 * between two ticks: it counts in the next one. `who` is for recordings, and may be NULL. False:
 * the node asks nothing, or has no such option. */
LOCKSTEP_EXPORT const char* lockstep_run_question(lockstep_run* run, uint32_t node);
LOCKSTEP_EXPORT bool lockstep_run_answer(lockstep_run* run, uint32_t node, const char* answer,
                                         const char* who);

/* Blackboard entries, between ticks, by key: "height", or "Deliver/height" in a SubTree. get fails
 * while nothing has written the entry. Numbers, flags and lists need an entry of their type; but
 * get_double also reads an int, and set_int sets the nearest double where the entry is one. Text is
 * written as in XML and works for all, also for objects whose type has texts. A text or list that
 * get gives is valid until the next call for this run; set copies. */
LOCKSTEP_EXPORT const char* lockstep_run_get_text(lockstep_run* run, const char* key);
LOCKSTEP_EXPORT bool lockstep_run_get_bool(lockstep_run* run, const char* key, bool* value);
LOCKSTEP_EXPORT bool lockstep_run_get_int(lockstep_run* run, const char* key, int64_t* value);
LOCKSTEP_EXPORT bool lockstep_run_get_double(lockstep_run* run, const char* key, double* value);
LOCKSTEP_EXPORT bool lockstep_run_set_text(lockstep_run* run, const char* key, const char* text);
/* Texts with their length, which may contain a NUL. */
LOCKSTEP_EXPORT bool lockstep_run_get_sized_text(lockstep_run* run, const char* key,
                                                 lockstep_text* text);
LOCKSTEP_EXPORT bool lockstep_run_set_sized_text(lockstep_run* run, const char* key,
                                                 const char* text, size_t length);
LOCKSTEP_EXPORT bool lockstep_run_set_bool(lockstep_run* run, const char* key, bool value);
LOCKSTEP_EXPORT bool lockstep_run_set_int(lockstep_run* run, const char* key, int64_t value);
LOCKSTEP_EXPORT bool lockstep_run_set_double(lockstep_run* run, const char* key, double value);
LOCKSTEP_EXPORT bool lockstep_run_get_bool_list(lockstep_run* run, const char* key,
                                                const bool** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_get_int_list(lockstep_run* run, const char* key,
                                               const int64_t** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_get_double_list(lockstep_run* run, const char* key,
                                                  const double** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_get_text_list(lockstep_run* run, const char* key,
                                                const lockstep_text** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_set_bool_list(lockstep_run* run, const char* key,
                                                const bool* values, size_t count);
LOCKSTEP_EXPORT bool lockstep_run_set_int_list(lockstep_run* run, const char* key,
                                               const int64_t* values, size_t count);
LOCKSTEP_EXPORT bool lockstep_run_set_double_list(lockstep_run* run, const char* key,
                                                  const double* values, size_t count);
LOCKSTEP_EXPORT bool lockstep_run_set_text_list(lockstep_run* run, const char* key,
                                                const lockstep_text* values, size_t count);
/* The type of the value that an entry has now, of which the get of that type returns it.
 * 0 while nothing has written the entry; and when no node uses it, with lockstep_last_error. */
LOCKSTEP_EXPORT lockstep_type lockstep_run_value_type(lockstep_run* run, const char* key);

/* The same by the index of the entry, without a search for its key: for programs that
 * read and write entries around each tick. Values, threads and errors are as above; an index that
 * no entry has is an error. Numbers and flags are read and written without an allocation. */
LOCKSTEP_EXPORT const char* lockstep_run_get_text_at(lockstep_run* run, uint32_t entry);
LOCKSTEP_EXPORT bool lockstep_run_get_bool_at(lockstep_run* run, uint32_t entry, bool* value);
LOCKSTEP_EXPORT bool lockstep_run_get_int_at(lockstep_run* run, uint32_t entry, int64_t* value);
LOCKSTEP_EXPORT bool lockstep_run_get_double_at(lockstep_run* run, uint32_t entry, double* value);
LOCKSTEP_EXPORT bool lockstep_run_set_text_at(lockstep_run* run, uint32_t entry, const char* text);
LOCKSTEP_EXPORT bool lockstep_run_get_sized_text_at(lockstep_run* run, uint32_t entry,
                                                    lockstep_text* text);
LOCKSTEP_EXPORT bool lockstep_run_set_sized_text_at(lockstep_run* run, uint32_t entry,
                                                    const char* text, size_t length);
LOCKSTEP_EXPORT bool lockstep_run_set_bool_at(lockstep_run* run, uint32_t entry, bool value);
LOCKSTEP_EXPORT bool lockstep_run_set_int_at(lockstep_run* run, uint32_t entry, int64_t value);
LOCKSTEP_EXPORT bool lockstep_run_set_double_at(lockstep_run* run, uint32_t entry, double value);
LOCKSTEP_EXPORT bool lockstep_run_get_bool_list_at(lockstep_run* run, uint32_t entry,
                                                   const bool** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_get_int_list_at(lockstep_run* run, uint32_t entry,
                                                  const int64_t** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_get_double_list_at(lockstep_run* run, uint32_t entry,
                                                     const double** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_get_text_list_at(lockstep_run* run, uint32_t entry,
                                                   const lockstep_text** values, size_t* count);
LOCKSTEP_EXPORT bool lockstep_run_set_bool_list_at(lockstep_run* run, uint32_t entry,
                                                   const bool* values, size_t count);
LOCKSTEP_EXPORT bool lockstep_run_set_int_list_at(lockstep_run* run, uint32_t entry,
                                                  const int64_t* values, size_t count);
LOCKSTEP_EXPORT bool lockstep_run_set_double_list_at(lockstep_run* run, uint32_t entry,
                                                     const double* values, size_t count);
LOCKSTEP_EXPORT bool lockstep_run_set_text_list_at(lockstep_run* run, uint32_t entry,
                                                   const lockstep_text* values, size_t count);
LOCKSTEP_EXPORT lockstep_type lockstep_run_value_type_at(lockstep_run* run, uint32_t entry);

/* Objects by reference, of a type that the program knows as the plugins do; an error for
 * an entry of another type, or of objects in another process. What get returns is borrowed, until
 * the next tick or write; set retains it. */
LOCKSTEP_EXPORT void* lockstep_run_get_object(lockstep_run* run, const char* key,
                                              const lockstep_object_type* type);
LOCKSTEP_EXPORT bool lockstep_run_set_object(lockstep_run* run, const char* key,
                                             const lockstep_object_type* type, void* object);
LOCKSTEP_EXPORT void* lockstep_run_get_object_at(lockstep_run* run, uint32_t entry,
                                                 const lockstep_object_type* type);
LOCKSTEP_EXPORT bool lockstep_run_set_object_at(lockstep_run* run, uint32_t entry,
                                                const lockstep_object_type* type, void* object);

/* The entries by their names, of a project with lockstep_project_open_entries: the board
 * of a tree, 0 for the main tree, for whoever releases it; NULL: there is none. The functions of a
 * board are those of lockstep/leaf.h. */
LOCKSTEP_EXPORT lockstep_board* lockstep_run_board(lockstep_run* run, uint32_t index);
LOCKSTEP_EXPORT const lockstep_boards* lockstep_boards_table(void);

/* The loop of the run ticks at once, if it waits for its next period; from any thread.
 * As when a leaf wants it: that is for types with LOCKSTEP_WAKES. */
LOCKSTEP_EXPORT void lockstep_run_wake(lockstep_run* run);

/* Called after each tick, also of the loop, in the thread that ticks. It may read the run, and must
 * not tick, halt or free it. Several may observe; NULL as `observe` removes those of this `user`.
 */
typedef void (*lockstep_observe)(void* user, lockstep_run* run, uint64_t tick, double seconds,
                                 lockstep_status status);
LOCKSTEP_EXPORT bool lockstep_run_observe(lockstep_run* run, lockstep_observe observe, void* user);

/* Keeps the state of the run in a file, and resumes it after a kill, a crash or a power failure:
 * docs/resume.md. */
typedef struct lockstep_keep_options {
  uint32_t struct_size;      /* set by the program; all else may be 0 */
  bool resume;               /* continue the run of the file, if it was cut */
  lockstep_status on_resume; /* what leaves do that ran at the cut and cannot continue:
                              * LOCKSTEP_IDLE, they start again; LOCKSTEP_SUCCESS or
                              * LOCKSTEP_FAILURE, their result. The attribute on_resume overrides
                              * it */
  uint32_t resume_limit;     /* how often in a row without a leaf that completes; 0: 3 */
  double sync;               /* seconds: written through to the disk at most so often; 0: 0.1 */
  const char* version;       /* of the program: a file of another one is refused. May be NULL */
} lockstep_keep_options;

typedef struct lockstep_resumed {
  uint32_t struct_size; /* set by the program */
  bool resumed;         /* false: the run is new, and what follows is 0 */
  uint64_t ticks;       /* before the cut. The numbers of ticks continue */
  double seconds;       /* the time of the last of them. The times of ticks continue from here */
  double gap;           /* seconds of the wall clock since then, in which there was no run */
  const char* text;     /* "resumed after 35 s; 'Main/left' continues at 0.42", or "". Valid as long
                         * as the run is kept */
} lockstep_resumed;

/* A leaf that ran at the cut. */
typedef struct lockstep_resumed_leaf {
  uint32_t struct_size; /* set by the program */
  uint32_t node;
  lockstep_status status; /* LOCKSTEP_RUNNING: it continues; LOCKSTEP_IDLE: it starts again in its
                           * next tick; LOCKSTEP_SUCCESS, LOCKSTEP_FAILURE: its next tick has this
                           * result, without a call */
  bool asked;             /* restore of the leaf has decided so */
  double progress;        /* of one that continues */
} lockstep_resumed_leaf;

/* Before the first tick of a new or restarted run, and before what watches it. After each tick, the
 * state of the run is given to a thread that writes it; with virtual_time, the tick waits until it
 * is written. What the program writes to entries after a tick is in the file after the next one.
 * After a result of the root, a fault or a halt, there is nothing to resume until the next tick
 * begins the tree. The end of a loop, lockstep_run_restart and lockstep_run_free end the file.
 *
 * A resumed run is as it was after its last tick in the file; its leaves are called in this
 * function, and may have a fault. `options` and `result` may be NULL. False, and the run is as
 * new: the file is of another run (another tree, argument, plugin, period, version), damaged, in
 * use, or was resumed too often; or the tree has an entry for objects. Also false: a leaf could not
 * be created in lockstep_run_restart. */
LOCKSTEP_EXPORT bool lockstep_run_keep(lockstep_run* run, const char* file,
                                       const lockstep_keep_options* options,
                                       lockstep_resumed* result);
/* The leaves that ran at the cut, from 0; false: no more. */
LOCKSTEP_EXPORT bool lockstep_run_resumed_leaf(lockstep_run* run, uint32_t index,
                                               lockstep_resumed_leaf* leaf);
/* Why nothing is kept any more, and since when, as on a full disk; NULL: all is kept, or nothing
 * was to be. The run continues; a leaf cannot commit any more. The log gets this once. Valid until
 * the next call for this run. */
LOCKSTEP_EXPORT const char* lockstep_run_not_kept(lockstep_run* run);

/* What else watches the run, as in the command `lockstep run`. Each before the
 * first tick, until lockstep_run_restart, lockstep_run_free or the end of a loop. All long work is
 * done in other threads; the time of the ticks is that of the program.
 *
 * Records the run to a file, for `lockstep replay` and `lockstep log` (--record). What a tick has
 * changed is written soon after it. A resumed run writes "run.resumed-1.jsonl" for "run.jsonl". If
 * it cannot be written any more, as on a full disk, the log gets a warning, and the run continues.
 */
LOCKSTEP_EXPORT bool lockstep_run_record(lockstep_run* run, const char* file);
/* Writes what recordings of this process have not written yet. Async-signal-safe: for a program
 * that handles its own crash. */
LOCKSTEP_EXPORT void lockstep_flush_recordings(void);
/* Shows the run in browsers (--monitor), which may only look. `address` is "8080", "0.0.0.0:8080",
 * or "0" for a free port. Returns the link for a person, valid until the next call for this run;
 * NULL: refused. */
LOCKSTEP_EXPORT const char* lockstep_run_monitor(lockstep_run* run, const char* address);
/* Shows the run in Groot2 (--groot2), which may only look; also after the first tick. `address` as
 * above, and the port after it too; NULL: not any more. Only for a project that was loaded with
 * lockstep_project_show_groot2. */
LOCKSTEP_EXPORT bool lockstep_run_groot2(lockstep_run* run, const char* address);

/* A property of the run, from its first tick to the first result of the root, a fault,
 * the end of a loop or a restart, after which it is checked again: "arm.running leads to arm.done
 * within 9 ticks" (docs/properties.md). NULL: those of the tree file, which are not checked else.
 * Before the first tick. */
LOCKSTEP_EXPORT bool lockstep_run_check(lockstep_run* run, const char* property);
/* Of the properties that are violated so far, in the order in which that was found: what and when
 * ("never arm.failure: violated in tick 3, at 0.300 s"). Of a run that continues, those of before
 * the cut come first ("…: violated in tick 3, before the cut"). NULL: no more. Valid until the next
 * tick or restart. */
LOCKSTEP_EXPORT const char* lockstep_run_violation(lockstep_run* run, uint32_t index);

/* An event of a node that is watched, while the tree is ticked. */
enum {
  /* It is ticked now. `status` is what it had; a result that is returned is its result in place of
   * the tick. Not when a script around it has decided (a pre-condition). */
  LOCKSTEP_BEFORE_TICK = 0,
  /* `status` is its result, also of such a script. Another one that is returned takes its place.
   * Not after a fault. */
  LOCKSTEP_AFTER_TICK = 1,
  /* It runs and is halted: before what runs in it, and after that. What is returned is ignored. */
  LOCKSTEP_BEFORE_HALT = 2,
  LOCKSTEP_AFTER_HALT = 3
};
/* Returns LOCKSTEP_IDLE to leave all as it is. A node that gets a result while it runs is halted.
 * LOCKSTEP_RUNNING, where that is not the status of the node after its tick, and what is no status
 * are a fault of the node.
 * It may read and write entries, and must not tick, halt, restart or free the run. */
typedef lockstep_status (*lockstep_watch_node)(void* user, lockstep_run* run, uint32_t node,
                                               int32_t what, lockstep_status status);
/* Calls for these nodes, and for no others, in the thread that ticks; NULL as `watch`: for none. A
 * node that is not watched costs nothing. A node that has completed is idle again, without a call,
 * when its parent has completed or begins again. Also within such a call. */
LOCKSTEP_EXPORT bool lockstep_run_watch_nodes(lockstep_run* run, const uint32_t* nodes,
                                              size_t count, lockstep_watch_node watch, void* user);

/* ---- Scripts -----------------------------------------------------------------------------------
 */

/* A script in the language of Script and _skipIf, over values that the program gives. It
 * is used by one thread at a time. */
typedef struct lockstep_script lockstep_script;
/* `words` are known to it as numbers; may be NULL. NULL: the text is no script. */
LOCKSTEP_EXPORT lockstep_script* lockstep_script_new(const char* text, size_t length,
                                                     const lockstep_words* words);
/* NULL is allowed. */
LOCKSTEP_EXPORT void lockstep_script_free(lockstep_script* script);
/* The names of entries in it, "@key" with its '@'; valid as long as the script. */
LOCKSTEP_EXPORT uint32_t lockstep_script_name_count(const lockstep_script* script);
LOCKSTEP_EXPORT const char* lockstep_script_name(const lockstep_script* script, uint32_t index);
/* Runs it. `values` has one for each name, `declared` 0 where there is no such entry. After the run
 * they are what the script has made of them, valid until its next call; `writes` is the number of
 * times it has written each. `result` is the value of the last statement; may be NULL. False after
 * an error: what was assigned before it stays. */
LOCKSTEP_EXPORT bool lockstep_script_run(lockstep_script* script, lockstep_entry_value* values,
                                         lockstep_entry_value* result);

/* ---- The fixed-rate loop -----------------------------------------------------------------------
 */

enum { LOCKSTEP_OVERRUN_SKIP = 0, LOCKSTEP_OVERRUN_CATCH_UP = 1, LOCKSTEP_OVERRUN_FAIL = 2 };
/* Why a loop ended. */
enum {
  LOCKSTEP_COMPLETED = 0,
  LOCKSTEP_FAULT = 1,
  LOCKSTEP_TIMEOUT = 2,
  LOCKSTEP_MAX_TICKS = 3,
  LOCKSTEP_STOPPED = 4, /* by `stop` */
  LOCKSTEP_OVERRUN = 5
};

typedef struct lockstep_loop_options {
  uint32_t struct_size; /* set by the program; all else may be 0 */
  int32_t overrun;      /* what happens to deadlines that a late tick misses */
  uint64_t max_ticks;   /* 0: any number */
  double timeout;       /* seconds; 0: none */
  bool virtual_clock;   /* time jumps to the next tick: as fast as possible, the same every time */
  /* Called before each tick, and on the wall clock also while the loop waits for the next one.
   * True: stop; it is not called again then. May be NULL */
  bool (*stop)(void* user);
  void* user;
} lockstep_loop_options;

typedef struct lockstep_loop_result {
  uint32_t struct_size; /* set by the program */
  int32_t reason;
  lockstep_status status; /* of the root after the last tick */
  uint64_t ticks;
  uint64_t overruns; /* ticks that ended after the next deadline */
  double seconds;
} lockstep_loop_result;

/* Ticks a new or restarted run once every tick_period until it completes or must stop, and halts
 * it. The thread sleeps in between. `options` and `result` may be NULL. False: an argument is
 * wrong. On the virtual clock max_ticks 0 is a million. */
LOCKSTEP_EXPORT bool lockstep_run_loop(lockstep_run* run, const lockstep_loop_options* options,
                                       lockstep_loop_result* result);

#ifdef __cplusplus
}
#endif

#endif
