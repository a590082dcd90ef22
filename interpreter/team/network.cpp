#include "team/network.h"

#include <fmt/format.h>
#include <signal.h>

#include <stdexcept>

#include "base/system/late_library.h"

namespace lockstep::host {
namespace {

// It stays: it has threads.
struct TeamModule : LateLibrary {
  explicit TeamModule(const std::string& file) : LateLibrary(file.c_str()) {}
  OpenTeam open = function("lockstep_open_team");
};

// Its threads take no signals: one must end the sleep of the thread that ticks.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all{};
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~WithoutSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

Result<std::unique_ptr<TeamTransport>> open_team_network(const std::string& module,
                                                         std::span<const TeamDeclaration> teams,
                                                         const TeamNetworkOptions& options) {
  try {
    const TeamModule loaded(module);
    const WithoutSignals scope;
    std::string why;
    std::unique_ptr<TeamTransport> transport(loaded.open(teams, options, why));
    if (transport == nullptr) return problem(std::move(why));
    return transport;
  } catch (const std::runtime_error& error) {
    return problem(
        fmt::format("this lockstep cannot reach a team: {}", error.what()),
        "build it with cyclonedds-dev and cyclonedds-tools installed (./dev build does); "
        "`lockstep team` simulates a team without a network");
  }
}

}  // namespace lockstep::host
