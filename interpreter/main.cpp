#include "cli/command.h"
#include "cli/exit_code.h"
#include "core/descriptors.h"
#include "runtime/crash_report.h"
#include "runtime/plugin_thread.h"

int main(int argc, char** argv) {
  lockstep::hold_standard_descriptors();
  lockstep::CrashReport::install(lockstep::kExitLeafCrash);
  lockstep::end_process(lockstep::run_program(argc, argv));
}
