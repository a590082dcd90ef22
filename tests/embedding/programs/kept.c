/* Ticks a tree and keeps it in a file: kept TREE FILE PERIOD [CUT_AT]. Prints each tick. With
 * CUT_AT, a leaf kills this process at that time, in the middle of a tick. PERIOD 0: the time of
 * the wall. */
#define _POSIX_C_SOURCE 200809L
#include <lockstep/runtime.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct Step {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int64_t done;
} Step;

static double cut_at = -1;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run) {
  (void)run;
  Step* const step = calloc(1, sizeof *step);
  if (step != NULL) *step = (Step){host, caller, 0};
  return step;
}
static void start(void* leaf) {
  ((Step*)leaf)->done = 0;
}
static int64_t ticks_of(const Step* step) {
  int64_t ticks = 1;
  step->host->get_int(step->caller, 0, &ticks);
  return ticks;
}
static lockstep_status tick(void* leaf) {
  Step* const step = leaf;
  if (cut_at >= 0 && step->host->now(step->caller) >= cut_at - 1e-9) raise(SIGKILL);
  return ++step->done == ticks_of(step) ? LOCKSTEP_SUCCESS : LOCKSTEP_RUNNING;
}
static double progress(void* leaf) {
  const Step* const step = leaf;
  return (double)step->done / (double)ticks_of(step);
}
static size_t save(void* leaf, void* bytes, size_t room) {
  if (room < sizeof(int64_t)) return 0;
  memcpy(bytes, &((Step*)leaf)->done, sizeof(int64_t));
  return sizeof(int64_t);
}
static lockstep_after_cut restore(void* leaf, const void* bytes, size_t size,
                                  const lockstep_cut* cut) {
  (void)cut;
  if (size != sizeof(int64_t)) return LOCKSTEP_STARTS_AGAIN;
  memcpy(&((Step*)leaf)->done, bytes, sizeof(int64_t));
  return LOCKSTEP_CONTINUES;
}

static const lockstep_port kTicks = {.struct_size = sizeof(lockstep_port),
                                     .type = LOCKSTEP_INT,
                                     .direction = LOCKSTEP_INPUT,
                                     .name = "ticks"};
static const lockstep_port* const kPorts[] = {&kTicks};
static const lockstep_leaf_type kStep = {.struct_size = sizeof(lockstep_leaf_type),
                                         .kind = LOCKSTEP_ACTION,
                                         .id = "Step",
                                         .port_count = 1,
                                         .ports = kPorts,
                                         .create = create,
                                         .destroy = free,
                                         .start = start,
                                         .tick = tick,
                                         .progress = progress,
                                         .save = save,
                                         .restore = restore};
static const lockstep_leaf_type* const kTypes[] = {&kStep};
static const lockstep_plugin kLeaves = {.abi_major = LOCKSTEP_ABI_MAJOR,
                                        .abi_minor = LOCKSTEP_ABI_MINOR,
                                        .struct_size = sizeof(lockstep_plugin),
                                        .name = "kept",
                                        .leaf_type_count = 1,
                                        .leaf_types = kTypes};

static double wall(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print_tick(lockstep_project* project, lockstep_run* run, uint64_t tick) {
  printf("%d", (int)tick);
  for (uint32_t i = 0; i < lockstep_project_node_count(project); ++i) {
    lockstep_node_state state = {.struct_size = sizeof state};
    lockstep_run_node(run, i, &state);
    printf(" %d:%.2f%s", state.status, state.progress, state.held ? "h" : "");
  }
  int64_t n = -1;
  lockstep_run_get_int(run, "n", &n);
  printf(" n=%d\n", (int)n);
  fflush(stdout);
}

static int failed(void) {
  printf("error: %s\n", lockstep_last_error());
  return 1;
}

int main(int count, char** arguments) {
  if (count < 4) return 2;
  const double period = atof(arguments[3]);
  if (count > 4) cut_at = atof(arguments[4]);
  lockstep_project* const project = lockstep_project_new();
  if (!lockstep_project_add_leaves(project, &kLeaves)) return failed();
  if (!lockstep_project_load_file(project, arguments[1])) return failed();
  const lockstep_run_options options = {.struct_size = sizeof options,
                                        .tick_period = period > 0 ? period : 0.001,
                                        .virtual_time = period > 0};
  lockstep_run* const run = lockstep_run_new(project, &options);
  if (run == NULL) return failed();
  const lockstep_keep_options keep = {
      .struct_size = sizeof keep, .resume = true, .version = getenv("KEPT_VERSION")};
  lockstep_resumed resumed = {.struct_size = sizeof resumed};
  if (!lockstep_run_keep(run, arguments[2], &keep, &resumed)) return failed();
  if (resumed.resumed) {
    printf("%s\n", resumed.text);
    lockstep_resumed_leaf leaf = {.struct_size = sizeof leaf};
    for (uint32_t i = 0; lockstep_run_resumed_leaf(run, i, &leaf); ++i) {
      printf("leaf %d is %d at %.2f, asked %d\n", (int)leaf.node, leaf.status, leaf.progress,
             leaf.asked);
    }
  }
  const double begun = wall() - resumed.seconds;
  uint64_t tick = resumed.ticks;
  lockstep_status status = LOCKSTEP_RUNNING;
  for (; status == LOCKSTEP_RUNNING && lockstep_run_fault(run, NULL) == NULL; ++tick) {
    status = lockstep_run_tick(run, period > 0 ? (double)tick * period : wall() - begun);
    print_tick(project, run, tick);
  }
  lockstep_run_free(run);
  lockstep_project_free(project);
  return status == LOCKSTEP_SUCCESS ? 0 : 1;
}
