#include <stdlib.h>
#include <unistd.h>

#include "base/system/descriptors.h"
#include "cli/command.h"
#include "cli/exit_code.h"
#include "run/crash_report.h"
#include "run/fuse.h"
#include "run/plugin_thread.h"

// NOLINTBEGIN(bugprone-reserved-identifier)
// Plugins that end the process call this: a name of the program is found before that of the C
// library.
extern "C" void _exit(int exit_code) {
  lockstep::host::CrashReport::foreign_exit();
  lockstep::host::end_at_once(exit_code);
}
extern "C" void _Exit(int exit_code) noexcept {
  _exit(exit_code);
}
// NOLINTEND(bugprone-reserved-identifier)

int main(int argc, char** argv) {
  lockstep::host::hold_standard_descriptors();
  lockstep::host::CrashReport::install(lockstep::host::kExitLeafCrash);
  lockstep::host::end_process(lockstep::host::run_program(argc, argv));
}
