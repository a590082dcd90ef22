#include "team/network.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <signal.h>

namespace lockstep::host {

Result<std::unique_ptr<TeamTransport>> open_team_network(const std::string& module,
                                                         std::span<const TeamDeclaration> teams,
                                                         const TeamNetworkOptions& options) {
  // It stays: it has threads.
  void* const handle = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    return tl::unexpected(
        Problem{fmt::format("this lockstep cannot reach a team: {}", dlerror()),
                "build it with cyclonedds-dev and cyclonedds-tools installed (./dev build does); "
                "`lockstep team` simulates a team without a network"});
  }
  const auto open = reinterpret_cast<OpenTeam>(dlsym(handle, "lockstep_open_team"));
  if (open == nullptr) return tl::unexpected(Problem{module + " is not of this lockstep", ""});
  // Its threads take no signals: one must end the sleep of the thread that ticks.
  sigset_t all{}, before{};
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  std::string why;
  std::unique_ptr<TeamTransport> transport(open(teams, options, why));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (transport == nullptr) return tl::unexpected(Problem{std::move(why), ""});
  return transport;
}

}  // namespace lockstep::host
