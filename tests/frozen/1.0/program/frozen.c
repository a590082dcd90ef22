/* A program of 1.0. `frozen` beside it was built from this source, with the header and the library of that version:
 *   cc -O2 -Iinterpreter/embedding -Iplugins/sdk frozen.c -o frozen build/release/liblockstep-runtime.so && strip frozen
 * frozen TREE PLUGINS: ticks the tree and prints each change of a node, and the entries at the end. */
#include <inttypes.h>
#include <lockstep/runtime.h>
#include <stdio.h>

static void on_log(void* user, const char* who, lockstep_log_level level, const char* message) {
  (void)user;
  printf("  %s (%d): %s\n", who, (int)level, message);
}

static void print_changes(lockstep_project* project, lockstep_run* run, int tick, int* shown) {
  for (uint32_t i = 0; i < lockstep_project_node_count(project); ++i) {
    lockstep_node node = {.struct_size = sizeof node};
    lockstep_node_state state = {.struct_size = sizeof state};
    if (!lockstep_project_node(project, i, &node) || !lockstep_run_node(run, i, &state)) continue;
    if (shown[i] == (int)state.status) continue;
    shown[i] = (int)state.status;
    printf("tick %d: %s is %d at %.17g\n", tick, node.path, shown[i], state.progress);
  }
}

static int run_tree(lockstep_project* project) {
  const lockstep_run_options options = {.struct_size = sizeof options, .seed = 7, .tick_period = 0.01, .log = on_log};
  lockstep_run* run = lockstep_run_new(project, &options);
  if (run == NULL) return puts(lockstep_last_error()), 1;
  int shown[100] = {0};
  lockstep_status status = LOCKSTEP_RUNNING;
  for (int tick = 0; status == LOCKSTEP_RUNNING && tick < 1000; ++tick) {
    status = lockstep_run_tick(run, tick * 0.01);
    print_changes(project, run, tick, shown);
  }
  double left = 0, right = 0;
  if (lockstep_run_get_double(run, "left", &left) && lockstep_run_get_double(run, "right", &right))
    printf("left %.17g, right %.17g\n", left, right);
  printf("status %d\n", (int)status);
  lockstep_run_halt(run);
  lockstep_run_free(run);
  return 0;
}

int main(int count, char** arguments) {
  if (count != 3) return 2;
  lockstep_project* project = lockstep_project_new();
  int code = 1;
  if (lockstep_project_add_plugin_path(project, arguments[2]) &&
      lockstep_project_load_file(project, arguments[1]) && lockstep_project_node_count(project) <= 100) {
    code = run_tree(project);
  } else {
    puts(lockstep_last_error());
  }
  lockstep_project_free(project);
  return code;
}
