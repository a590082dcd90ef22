// lockstep-leafhost: the process in which an isolated plugin lives, or the guardian of one that is
// a program. Started by lockstep only.
#include <unistd.h>

#include <string_view>

#include "base/system/descriptors.h"
#include "leaves/remote/json_lines/guardian.h"
#include "leaves/remote/shared_memory/served_plugin.h"
#include "run/crash_report.h"
#include "run/plugin_thread.h"

namespace {

constexpr int kExitUsage = 2;

constexpr const char* kHelp =
    "lockstep-leafhost: the process in which lockstep runs an isolated plugin\n"
    "\n"
    "It is started by lockstep ('lockstep run --isolate', or <plugin name=\"...\" "
    "isolate=\"true\"/>\n"
    "in a tree), one for each plugin and run, and ends with it. With --program it starts a "
    "process\n"
    "plugin, and ends it. Do not start it yourself.\n";

}  // namespace

int main(int argc, char** argv) {
  lockstep::host::hold_standard_descriptors();
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first == "--help" || first == "-h") {
    return lockstep::host::write_all(STDOUT_FILENO, kHelp) ? 0 : kExitUsage;
  }
  if (argc == 3 && first == "--program" && lockstep::host::is_guardian()) {
    return lockstep::host::guard_program(argv[2]);
  }
  if (argc != 2 || !lockstep::host::ServedPlugin::has_host()) {
    lockstep::host::write_all(
        STDERR_FILENO,
        "lockstep-leafhost: is started by lockstep only; 'lockstep run --isolate' does it\n");
    return kExitUsage;
  }
  // The host reports that the process died; only this process knows which function was called.
  lockstep::host::CrashReport::install(lockstep::host::CrashReport::kAsWithoutReport);
  lockstep::host::end_process(lockstep::host::ServedPlugin::serve(argv[1]));
}
