#include "cli/run/keep.h"

#include <fmt/format.h>

#include <utility>

#include "cli/console.h"
#include "cli/exit_code.h"

namespace lockstep::host {

TreeIdentity identity_of_run(const RunCommandOptions& options, const Loaded& loaded) {
  TreeIdentity identity = identity_of(loaded, text_mark);
  identity.emplace_back("--rate", fmt::format("{}", options.rate));
  identity.emplace_back("--tick", options.exactly_once ? "exactly-once" : "once");
  identity.emplace_back("--on-fault", options.on_fault == FaultPolicy::Stop ? "stop" : "fail");
  return identity;
}

tl::expected<std::unique_ptr<KeptRun>, int> keep(const RunCommandOptions& options,
                                                 TreeIdentity identity, const Tree& tree) {
  if (options.keep.file.empty()) return nullptr;
  auto kept = KeptRun::open(options.kept(), std::move(identity), tree);
  if (kept) return std::move(*kept);
  const auto& [why, problem] = kept.error();
  switch (why) {
    case NotKept::Why::Objects:
      if (!options.checkpoint_required) {
        print_note("--checkpoint: " + problem.message,
                   "nothing is kept: after a cut, the run starts from its beginning");
        return nullptr;
      }
      print_error("--checkpoint: " + problem.message, "run this tree without --checkpoint");
      return tl::unexpected(kExitInvalidTree);
    case NotKept::Why::File:
      print_error("--checkpoint: " + problem.message);
      return tl::unexpected(kExitUsage);
    case NotKept::Why::OtherRun:
    case NotKept::Why::TooOften:
      break;
  }
  print_error("--resume: " + problem.message, problem.hint);
  return tl::unexpected(why == NotKept::Why::TooOften ? kExitLeafFault : kExitInvalidTree);
}

}  // namespace lockstep::host
