/* A plugin of a minor to come: each struct has a member more than this host knows. */
#define lockstep_plugin_entry entry_as_declared
#include "probe.h"
#undef lockstep_plugin_entry

typedef struct newer_port {
  lockstep_port base;
  const char* more;
} newer_port;
typedef struct newer_leaf_type {
  lockstep_leaf_type base;
  void (*more)(void* leaf);
} newer_leaf_type;
typedef struct newer_plugin {
  lockstep_plugin base;
  const char* more;
} newer_plugin;

static void more(void* leaf) {
  (void)leaf;
}

static const newer_port port = {{sizeof(newer_port), LOCKSTEP_INT, LOCKSTEP_INPUT, "ticks", "2",
                                 NULL, NULL, NULL, 0, 0, NULL, 0},
                                "more"};
static const lockstep_port* const ports[] = {&port.base};
static const newer_leaf_type leaf_type = {{sizeof(newer_leaf_type),
                                           LOCKSTEP_ACTION,
                                           "Probe",
                                           NULL,
                                           1,
                                           ports,
                                           probe_create,
                                           probe_destroy,
                                           probe_start,
                                           probe_tick,
                                           probe_halt,
                                           NULL,
                                           NULL,
                                           NULL,
                                           NULL,
                                           0,
                                           0,
                                           0,
                                           NULL,
                                           0,
                                           NULL,
                                           NULL,
                                           NULL,
                                           NULL,
                                           NULL,
                                           NULL,
                                           NULL},
                                          more};
static const lockstep_leaf_type* const leaf_types[] = {&leaf_type.base};

extern LOCKSTEP_EXPORT const newer_plugin lockstep_plugin_entry;
const newer_plugin lockstep_plugin_entry = {
    {LOCKSTEP_ABI_MAJOR, LOCKSTEP_ABI_MINOR + 1, sizeof(newer_plugin), "newer_minor", NULL, NULL, 1,
     leaf_types, NULL, NULL, NULL, NULL, NULL, NULL},
    "more"};
