#include "cli/reach_run.h"

#include <pwd.h>
#include <unistd.h>

#include <optional>

#include "base/core/value.h"
#include "show/web/registry.h"

namespace lockstep::host {

std::vector<ReachableRun> reachable_runs(const std::string& run) {
  if (!run.empty() && !parse_int(run)) return {{run, run}};
  std::vector<ReachableRun> found;
  for (const RegisteredRun& it : registered_runs()) {
    const std::string process = std::to_string(it.process);
    if (!it.socket.empty() && (run.empty() || run == process))
      found.push_back({it.socket, process});
  }
  return found;
}

std::string user_name() {
  const passwd* const user = getpwuid(geteuid());
  return user != nullptr ? user->pw_name : std::to_string(geteuid());
}

}  // namespace lockstep::host
