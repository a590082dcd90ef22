/* Ticks the leaf of the plugin that is its argument. Nothing in this process has thrown before. */
#include <lockstep/runtime.h>
#include <stdio.h>
#include <string.h>

static const char kTree[] =
    "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Throws/></BehaviorTree></root>";

static int failed(void) {
  puts(lockstep_last_error());
  return 1;
}

int main(int count, char** arguments) {
  lockstep_project* const project = lockstep_project_new();
  if (count != 2 || !lockstep_project_add_plugin(project, arguments[1])) return failed();
  if (!lockstep_project_load_text(project, "tree", kTree, strlen(kTree))) return failed();
  lockstep_run* const run = lockstep_run_new(project, NULL);
  if (run == NULL) return failed();
  lockstep_run_tick(run, 0);
  const char* const fault = lockstep_run_fault(run, NULL);
  const int is_good =
      fault != NULL && strstr(fault, "threw an exception: the gripper is gone") != NULL;
  puts(fault == NULL ? "no fault" : fault);
  lockstep_run_free(run);
  lockstep_project_free(project);
  return is_good ? 0 : 1;
}
