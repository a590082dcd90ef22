/* A leaf that dies, or never returns, in the function that its port 'where' names, in the way that
 * 'how' names; else it runs for ever. `log` it does when it is created, so that a line comes before
 * the end. */
#define _GNU_SOURCE
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lockstep/leaf.h"

static const lockstep_host* g_host;

static bool port_is(const lockstep_caller* caller, uint32_t port, const char* word) {
  const char* text = "";
  size_t length = 0;
  g_host->get_string(caller, port, &text, &length);
  return strcmp(text, word) == 0;
}

static volatile int g_depth;

static int overflow(int depth) {
  volatile char frame[4096];
  frame[0] = (char)depth;
  return g_depth == INT_MAX ? 0 : overflow(depth + 1) + frame[0];
}

/* A signal that ends the process also where a sanitizer listens for it. */
static void die_by(int signal_number) {
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

/* Starts a process that never ends, and logs its number and ours. */
static void leave_offspring(const lockstep_caller* caller) {
  char text[64];
  const pid_t child = fork();
  while (child == 0) pause();
  snprintf(text, sizeof text, "%d %d", (int)child, (int)getpid());
  g_host->log(caller, LOCKSTEP_LOG_INFO, text);
}

static void reached(const lockstep_caller* caller, const char* function) {
  if (!port_is(caller, 0, function)) return;
  if (port_is(caller, 1, "segv")) die_by(SIGSEGV);
  if (port_is(caller, 1, "abort")) die_by(SIGABRT);
  if (port_is(caller, 1, "raise")) raise(SIGSEGV);
  if (port_is(caller, 1, "overflow")) g_depth = overflow(1);
  if (port_is(caller, 1, "exit")) exit(3);
  if (port_is(caller, 1, "_exit")) _exit(4);
  if (port_is(caller, 1, "fork")) leave_offspring(caller);
  if (port_is(caller, 1, "stop")) raise(SIGSTOP);
  if (port_is(caller, 1, "close")) close_range(0, ~0u, 0);
  if (port_is(caller, 1, "join the host")) {
    setpgid(0, getpgid(getppid()));
    for (;;) pause();
  }
  while (port_is(caller, 1, "hang")) pause();
}

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run_context) {
  (void)run_context;
  g_host = host;
  host->log(caller, LOCKSTEP_LOG_INFO, "create");
  reached(caller, "create");
  return (void*)caller;
}
static void destroy(void* leaf) {
  reached((const lockstep_caller*)leaf, "destroy");
}
static void start(void* leaf) {
  reached((const lockstep_caller*)leaf, "start");
}
static lockstep_status tick(void* leaf) {
  reached((const lockstep_caller*)leaf, "tick");
  return LOCKSTEP_RUNNING;
}
static void halt(void* leaf) {
  reached((const lockstep_caller*)leaf, "halt");
}
static double progress(void* leaf) {
  reached((const lockstep_caller*)leaf, "progress");
  return 0.25;
}

#define PORT(variable, port_name)                                              \
  static const lockstep_port variable = {.struct_size = sizeof(lockstep_port), \
                                         .type = LOCKSTEP_STRING,              \
                                         .direction = LOCKSTEP_INPUT,          \
                                         .name = port_name,                    \
                                         .default_value = ""}
PORT(where_port, "where");
PORT(how_port, "how");
static const lockstep_port* const ports[] = {&where_port, &how_port};
static const lockstep_leaf_type leaf_type = {.struct_size = sizeof(lockstep_leaf_type),
                                             .kind = LOCKSTEP_ACTION,
                                             .id = "Crash",
                                             .port_count = 2,
                                             .ports = ports,
                                             .create = create,
                                             .destroy = destroy,
                                             .start = start,
                                             .tick = tick,
                                             .halt = halt,
                                             .progress = progress};
static const lockstep_leaf_type* const leaf_types[] = {&leaf_type};

const lockstep_plugin lockstep_plugin_entry = {.abi_major = LOCKSTEP_ABI_MAJOR,
                                               .abi_minor = LOCKSTEP_ABI_MINOR,
                                               .struct_size = sizeof(lockstep_plugin),
                                               .name = "crash",
                                               .version = "1.0.0",
                                               .leaf_type_count = 1,
                                               .leaf_types = leaf_types};
