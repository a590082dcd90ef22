/* The tables of a plugin named after its file, with one leaf 'Probe' that has one port 'ticks'.
 * Whoever includes this has defined what is to be different. */
#include "probe.h"

#ifndef ABI_MAJOR
#define ABI_MAJOR LOCKSTEP_ABI_MAJOR
#endif
#ifndef ABI_MINOR
#define ABI_MINOR LOCKSTEP_ABI_MINOR
#endif
#ifndef PLUGIN_SIZE
#define PLUGIN_SIZE sizeof(lockstep_plugin)
#endif
#ifndef PLUGIN_NAME
#define PLUGIN_NAME FILE_NAME
#endif
#ifndef PLUGIN_INIT
#define PLUGIN_INIT NULL
#endif
#ifndef PLUGIN_CREATE_RUN
#define PLUGIN_CREATE_RUN NULL
#endif
#ifndef PLUGIN_DESCRIBE
#define PLUGIN_DESCRIBE NULL
#endif
#ifndef PLUGIN_DESTROY_RUN
#define PLUGIN_DESTROY_RUN NULL
#endif
#ifndef LEAF_COUNT
#define LEAF_COUNT 1
#endif
#ifndef LEAF_LIST
#define LEAF_LIST the_leaf_types
#endif
#ifndef LEAF_SIZE
#define LEAF_SIZE sizeof(lockstep_leaf_type)
#endif
#ifndef LEAF_KIND
#define LEAF_KIND LOCKSTEP_ACTION
#endif
#ifndef LEAF_ID
#define LEAF_ID "Probe"
#endif
#ifndef LEAF_DOC
#define LEAF_DOC "runs and logs its calls"
#endif
#ifndef LEAF_CREATE
#define LEAF_CREATE probe_create
#endif
#ifndef LEAF_DESTROY
#define LEAF_DESTROY probe_destroy
#endif
#ifndef LEAF_START
#define LEAF_START probe_start
#endif
#ifndef LEAF_TICK
#define LEAF_TICK probe_tick
#endif
#ifndef LEAF_HALT
#define LEAF_HALT probe_halt
#endif
#ifndef LEAF_PROGRESS
#define LEAF_PROGRESS NULL
#endif
#ifndef LEAF_GET_EXTENSION
#define LEAF_GET_EXTENSION NULL
#endif
#ifndef LEAF_FLAGS
#define LEAF_FLAGS 0
#endif
#ifndef LEAF_MIN_CHILDREN
#define LEAF_MIN_CHILDREN 0
#endif
#ifndef LEAF_MAX_CHILDREN
#define LEAF_MAX_CHILDREN 0
#endif
#ifndef LEAF_BEHAVIOR_COUNT
#define LEAF_BEHAVIOR_COUNT 0
#endif
#ifndef LEAF_BEHAVIOR
#define LEAF_BEHAVIOR NULL
#endif
#ifndef LEAF_MORE_PORTS
#define LEAF_MORE_PORTS NULL
#endif
#ifndef LEAF_DESCRIBE
#define LEAF_DESCRIBE NULL
#endif
#ifndef LEAF_DATA
#define LEAF_DATA NULL
#endif
#ifndef PORT_COUNT
#define PORT_COUNT 1
#endif
#ifndef PORT_LIST
#define PORT_LIST the_ports
#endif
#ifndef PORT_SIZE
#define PORT_SIZE sizeof(lockstep_port)
#endif
#ifndef PORT_TYPE
#define PORT_TYPE LOCKSTEP_INT
#endif
#ifndef PORT_DIRECTION
#define PORT_DIRECTION LOCKSTEP_INPUT
#endif
#ifndef PORT_NAME
#define PORT_NAME "ticks"
#endif
#ifndef PORT_DEFAULT
#define PORT_DEFAULT "2"
#endif

#ifndef PORT_CHOICES
#define PORT_CHOICES NULL
#endif
#ifndef PORT_FLAGS
#define PORT_FLAGS 0
#endif
#ifndef PORT_OBJECT
#define PORT_OBJECT NULL
#endif
#ifndef PORT_MIN
#define PORT_MIN 0
#endif
#ifndef PORT_MAX
#define PORT_MAX 0
#endif

/* Some files refer to other lists than these. */
#define MAYBE_UNUSED __attribute__((unused))

static const lockstep_port the_port = {PORT_SIZE,
                                       PORT_TYPE,
                                       PORT_DIRECTION,
                                       PORT_NAME,
                                       PORT_DEFAULT,
                                       NULL,
                                       "how many ticks it runs",
                                       PORT_CHOICES,
                                       PORT_MIN,
                                       PORT_MAX,
                                       PORT_OBJECT,
                                       PORT_FLAGS};
MAYBE_UNUSED static const lockstep_port* const the_ports[] = {&the_port, &the_port};

static const lockstep_leaf_type the_leaf_type = {LEAF_SIZE,
                                                 LEAF_KIND,
                                                 LEAF_ID,
                                                 LEAF_DOC,
                                                 PORT_COUNT,
                                                 PORT_LIST,
                                                 LEAF_CREATE,
                                                 LEAF_DESTROY,
                                                 LEAF_START,
                                                 LEAF_TICK,
                                                 LEAF_HALT,
                                                 NULL,
                                                 NULL,
                                                 LEAF_PROGRESS,
                                                 LEAF_GET_EXTENSION,
                                                 LEAF_FLAGS,
                                                 LEAF_MIN_CHILDREN,
                                                 LEAF_MAX_CHILDREN,
                                                 NULL,
                                                 LEAF_BEHAVIOR_COUNT,
                                                 LEAF_BEHAVIOR,
                                                 LEAF_MORE_PORTS,
                                                 LEAF_DESCRIBE,
                                                 LEAF_DATA,
                                                 NULL,
                                                 NULL,
                                                 NULL};
MAYBE_UNUSED static const lockstep_leaf_type* const the_leaf_types[] = {&the_leaf_type,
                                                                        &the_leaf_type};

const lockstep_plugin lockstep_plugin_entry = {
    ABI_MAJOR,         ABI_MINOR,          PLUGIN_SIZE, PLUGIN_NAME,    "1.0.0",
    "for tests",       LEAF_COUNT,         LEAF_LIST,   PLUGIN_INIT,    NULL,
    PLUGIN_CREATE_RUN, PLUGIN_DESTROY_RUN, NULL,        PLUGIN_DESCRIBE};
