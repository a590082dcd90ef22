/* The C interface: loads a tree, ticks it by hand, and prints each change of the root's progress.
 *   in_c tree.xml [plugin directory] */
#include <lockstep/runtime.h>
#include <stdio.h>

/* What is wrong with the tree. */
static void print_diagnostics(const lockstep_project* project) {
  for (uint32_t i = 0; i < lockstep_project_diagnostic_count(project); ++i) {
    lockstep_diagnostic it = {.struct_size = sizeof it};
    if (!lockstep_project_diagnostic(project, i, &it)) return;
    fprintf(stderr, "%s:%u:%u: %s\n", it.file, it.line, it.column, it.message);
    if (*it.hint != '\0') fprintf(stderr, "  hint: %s\n", it.hint);
  }
}

static void on_log(void* user, const char* who, lockstep_log_level level, const char* message) {
  (void)user;
  (void)level;
  printf("%s: %s\n", who, message);
}

static int run_tree(lockstep_project* project) {
  const lockstep_run_options options = {
      .struct_size = sizeof options, .seed = 1, .tick_period = 0.01, .log = on_log};
  lockstep_run* run = lockstep_run_new(project, &options);
  if (run == NULL) {
    fprintf(stderr, "in_c: %s\n", lockstep_last_error());
    return 1;
  }
  lockstep_status status = LOCKSTEP_RUNNING;
  int shown = -1;
  for (int tick = 0; status == LOCKSTEP_RUNNING && tick < 100000; ++tick) {
    status = lockstep_run_tick(run, tick * 0.01);
    lockstep_node_state root = {.struct_size = sizeof root};
    if (lockstep_run_fault(run, NULL) != NULL || !lockstep_run_node(run, 0, &root)) break;
    const int tenths = (int)(root.progress * 10);
    if (tenths > shown) printf("%.2f s: %d %%\n", tick * 0.01, 10 * (shown = tenths));
  }
  const char* fault = lockstep_run_fault(run, NULL);
  if (fault != NULL) fprintf(stderr, "in_c: %s\n", fault);
  printf("%s\n", status == LOCKSTEP_SUCCESS ? "success" : "no success");
  lockstep_run_halt(run);
  lockstep_run_free(run);
  return status == LOCKSTEP_SUCCESS ? 0 : 1;
}

int main(int count, char** arguments) {
  if (count < 2) {
    fprintf(stderr, "usage: in_c tree.xml [plugin directory]\n");
    return 2;
  }
  lockstep_project* project = lockstep_project_new();
  if (count > 2) lockstep_project_add_plugin_path(project, arguments[2]);
  const bool loaded = lockstep_project_load_file(project, arguments[1]);
  print_diagnostics(project);
  const int code = loaded ? run_tree(project) : 2;
  lockstep_project_free(project);
  return code;
}
