// In place of required_ticket.cpp, where the tools are left out.
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/run/required_ticket.h"

namespace lockstep::host {

int require_ticket(RunCommandOptions&, const Loaded&) {
  print_error("--require-ticket: this lockstep was built without tickets",
              "./dev build, or cmake -DLOCKSTEP_TOOLS=ON and build again");
  return kExitUsage;
}

}  // namespace lockstep::host
