// lockstep_run: kept in a checkpoint file, and resumed from it.
#include <fmt/format.h>

#include <utility>

#include "base/core/audience.h"
#include "embedding/run_handle.h"

namespace lockstep::host::embedding {
namespace {

// What makes the run, beside the tree.
TreeIdentity identity_of(const lockstep_run& run, const lockstep_keep_options& options) {
  TreeIdentity identity = run.program->identity;
  identity.emplace_back("the tick period", fmt::format("{} s", 1 / run.rate));
  identity.emplace_back("on_fault", run.fails_on_fault ? "fail" : "stop");
  if (options.version != nullptr)
    identity.emplace_back("the version of the program", options.version);
  return identity;
}

// Nothing: an option is wrong.
std::optional<KeepOptions> keep_options(const char* file, const lockstep_keep_options& given) {
  constexpr double kMostSeconds = 1e6;
  KeepOptions options{.file = file, .resumes = given.resume};
  const bool is_known = given.on_resume == LOCKSTEP_IDLE || given.on_resume == LOCKSTEP_SUCCESS ||
                        given.on_resume == LOCKSTEP_FAILURE;
  if (!is_known) fail("on_resume is not LOCKSTEP_IDLE, LOCKSTEP_SUCCESS or LOCKSTEP_FAILURE");
  const bool is_time = given.sync >= 0 && given.sync <= kMostSeconds;
  if (is_known && !is_time) fail("sync is not a number of seconds");
  if (!is_known || !is_time || (given.version != nullptr && !is_text("the version", given.version)))
    return std::nullopt;
  if (given.on_resume == LOCKSTEP_SUCCESS) options.on_resume = AfterCut::Success;
  if (given.on_resume == LOCKSTEP_FAILURE) options.on_resume = AfterCut::Failure;
  if (given.resume_limit != 0) options.resume_limit = given.resume_limit;
  if (given.sync != 0) options.sync = from_seconds(given.sync);
  return options;
}

lockstep_status status_after(AfterCut does) {
  switch (does) {
    case AfterCut::StartsAgain:
      return LOCKSTEP_IDLE;
    case AfterCut::Continues:
      return LOCKSTEP_RUNNING;
    case AfterCut::Success:
      return LOCKSTEP_SUCCESS;
    case AfterCut::Failure:
      break;
  }
  return LOCKSTEP_FAILURE;
}

lockstep_resumed resumed(const KeptRun& kept) {
  const LoopOptions::Before before = kept.before();
  return {.struct_size = 0,
          .resumed = kept.continues(),
          .ticks = before.ticks,
          .seconds = to_seconds(before.time),
          .gap = to_seconds(before.gap),
          .text = kept.resumed().c_str()};
}

bool keep(lockstep_run& run, KeepOptions options, const lockstep_keep_options& given) {
  options.real_time = run.is_real;
  auto kept =
      KeptRun::open(std::move(options), identity_of(run, given), run.program->runnable.tree);
  if (!kept) return refuse(kept.error().problem);
  (*kept)->set_properties(run.properties.checks());
  const auto why_not = (*kept)->begin(run.run, [&run](const std::string& error) {
    run.leaf_log()("lockstep", LOCKSTEP_LOG_WARNING, "nothing is kept any more: " + error);
  });
  if (why_not) {
    run.run.restart(run.seed);
    return refuse(*why_not);
  }
  run.kept = std::move(*kept);
  if (run.kept->continues()) run.properties.go_on(run.kept->kept_properties());
  run.tell_fresh_properties(0);
  const LoopOptions::Before before = run.kept->before();
  run.first_tick = run.run.ticker().tick_number();
  run.last = before.time;
  run.watchers.go_on(before.ticks, before.gap, before.set, run.kept->resumed());
  return true;
}

}  // namespace
}  // namespace lockstep::host::embedding

using namespace lockstep::host;
using namespace lockstep::host::embedding;

bool lockstep_run_keep(lockstep_run* run, const char* file, const lockstep_keep_options* given,
                       lockstep_resumed* result) {
  return guarded([&] {
    const ForProgram scope;
    if (run == nullptr || file == nullptr) return fail("an argument is NULL");
    const Busy busy(*run);
    if (busy.is_refused()) return false;
    if (run->kept != nullptr) return fail("the run is kept already");
    if (!run->is_new())
      return fail("the run has been ticked already: it is kept from its first tick on");
    // A leaf could not be created in its restart: there is nothing to keep.
    if (const Fault* const fault = run->run.fault()) return fail(fault_text(*run, *fault));
    if (run->watchers.log_somewhere()) return fail("the run is watched already: keep it first");
    const lockstep_keep_options read = read_struct(given);
    const auto options = keep_options(file, read);
    if (!options || !keep(*run, *options, read)) return false;
    return result == nullptr || write_struct(resumed(*run->kept), result);
  });
}

bool lockstep_run_resumed_leaf(lockstep_run* run, uint32_t index, lockstep_resumed_leaf* leaf) {
  return guarded([&] {
    if (run == nullptr || run->kept == nullptr || index >= run->kept->cut_leaves().size()) {
      return fail("no such leaf");
    }
    const CutLeaf& cut = run->kept->cut_leaves()[index];
    return write_struct({.struct_size = 0,
                         .node = tree_of(*run).leaves[cut.place].node,
                         .status = status_after(cut.does),
                         .asked = cut.is_asked,
                         .progress = cut.progress},
                        leaf);
  });
}

const char* lockstep_run_not_kept(lockstep_run* run) {
  return shielded([&]() -> const char* {
    if (run == nullptr) return nullptr;
    if (run->kept != nullptr) run->not_kept = run->kept->error();
    return run->not_kept.empty() ? nullptr : run->not_kept.c_str();
  });
}
