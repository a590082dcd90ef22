#include "cli/run/kept_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "base/core/crc32c.h"
#include "base/core/wording.h"
#include "base/system/boot_id.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/tree_identity.h"
#include "engine/tree.h"
#include "run/checkpoint/run_bytes.h"
#include "run/cut_text.h"

namespace lockstep::host {
namespace {

// Of 3 s and more without a fraction: who reads it has waited so long.
std::string duration_text(Nanoseconds time) {
  const double seconds = to_seconds(std::max(time, Nanoseconds(0)));
  return seconds < 3 ? fmt::format("{:.1f} s", seconds) : fmt::format("{:.0f} s", seconds);
}

// What no text says, as which nodes are mocks.
std::string nodes_mark(const Tree& tree) {
  std::string all;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    all += fmt::format("{} {} {} {}\n", tree.labels[node].type->id, tree.labels[node].name,
                       tree.nodes[node].end, tree.nodes[node].state);
  }
  for (const Slot& slot : tree.slots) {
    all += fmt::format("{} {} {}\n", slot.name, static_cast<int>(slot.type),
                       static_cast<int>(slot.typing));
  }
  return fmt::format("{}, {:08x}", counted(tree.nodes.size(), "node"), crc32c(all));
}

std::string value_text(const std::string& value) {
  return value.empty() ? "nothing" : "'" + printable(value) + "'";
}

lockstep_cut cut_of(const Checkpoint& from, const RunCommandOptions& options, Nanoseconds period) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const Nanoseconds gap =
      std::chrono::seconds(now.tv_sec) + Nanoseconds(now.tv_nsec) - from.written;
  const bool power = from.boot != boot_id();
  const Nanoseconds sync = power ? CheckpointWriter::longest_sync(options.sync()) : Nanoseconds(0);
  const std::uint64_t ticks = (CheckpointWriter::pause_of(period) + sync) / period + 2;
  return {.struct_size = sizeof(lockstep_cut),
          .power = power,
          .held = false,
          .gap = std::max(to_seconds(gap), 0.0),
          .lost_ticks = options.is_real() ? ticks
                        : power           ? UINT64_MAX
                                          : 1};
}

}  // namespace

CheckpointFacts KeptRun::facts_of(const RunCommandOptions& options, const Loaded& loaded) {
  CheckpointFacts facts;
  facts.identity = identity_of(loaded, text_mark);
  const auto add = [&](std::string name, std::string value) {
    facts.identity.emplace_back(std::move(name), std::move(value));
  };
  add("--rate", fmt::format("{}", options.rate));
  add("--tick", options.exactly_once ? "exactly-once" : "once");
  add("--on-fault", options.on_fault == FaultPolicy::Stop ? "stop" : "fail");
  return facts;
}

tl::expected<std::unique_ptr<KeptRun>, int> KeptRun::open(const RunCommandOptions& options,
                                                          CheckpointFacts facts, const Tree& tree) {
  if (options.checkpoint.empty()) return nullptr;
  if (const auto entry = entry_for_objects(tree)) {
    const std::string message = fmt::format(
        "--checkpoint: the entry '{}' holds objects, which no checkpoint has", printable(*entry));
    if (options.checkpoint_required) {
      print_error(message, "run this tree without --checkpoint");
      return tl::unexpected(kExitInvalidTree);
    }
    print_note(message, "nothing is kept: after a cut, the run starts from its beginning");
    return nullptr;
  }
  facts.identity.emplace_back("the nodes and entries", nodes_mark(tree));
  std::vector<bool> is_leaf(tree.nodes.size());
  for (const LeafNode& leaf : tree.leaves) is_leaf[leaf.node] = true;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    facts.nodes.push_back(tree.path(node));
    facts.is_leaf.push_back(is_leaf[node] ? 1 : 0);
  }
  std::unique_ptr<KeptRun> kept(new KeptRun(options, std::move(facts), tree));
  kept->file_ = std::make_unique<CheckpointFile>(options.checkpoint);
  if (!kept->file_->error().empty()) {
    print_error("--checkpoint: " + printable(kept->file_->error()));
    return tl::unexpected(kExitUsage);
  }
  const int refused = options.resumes ? kept->read() : kExitSuccess;
  if (refused != kExitSuccess) return tl::unexpected(refused);
  return kept;
}

int KeptRun::read() {
  auto kept = read_checkpoint_file(options_.checkpoint);
  if (!kept) {
    print_error("--resume: " + printable(kept.error().message),
                "remove the file to start a new run");
    return kExitInvalidTree;
  }
  if (!*kept || (*kept)->checkpoint.kind == Checkpoint::Kind::Ended) return kExitSuccess;
  if (const int refused = refuse(**kept); refused != kExitSuccess) return refused;
  if ((*kept)->checkpoint.ticks != 0) from_ = std::move((*kept)->checkpoint);
  return kExitSuccess;
}

int KeptRun::refuse(const KeptCheckpoint& kept) {
  const std::string begin = fmt::format("--resume: '{}' ", printable(options_.checkpoint));
  const std::string hint = "remove the file to start a new run";
  if (kept.checkpoint.kind == Checkpoint::Kind::Lost) {
    print_error(begin + fmt::format("has no state of its run after {}: {}",
                                    counted(kept.checkpoint.ticks, "tick"),
                                    printable(kept.checkpoint.note)),
                hint);
    return kExitInvalidTree;
  }
  const auto found = differences(kept.facts, facts_);
  if (!found.empty()) {
    const Difference& it = found.front();
    std::string more = found.size() == 1
                           ? ""
                           : fmt::format(", and {} more", counted(found.size() - 1, "difference"));
    print_error(begin + fmt::format("is of another run: {} was {} and is {}{}", printable(it.name),
                                    value_text(it.kept), value_text(it.now), more),
                hint);
    return kExitInvalidTree;
  }
  if (kept.checkpoint.resumes >= options_.resume_limit) {
    print_error(begin + fmt::format("was resumed {} in a row and no leaf has completed",
                                    counted(kept.checkpoint.resumes, "time")),
                hint + ", or give a larger --resume-limit");
    return kExitLeafFault;
  }
  if (!read_bytes(kept.checkpoint.run, tree_, saved_, leaves_)) {
    print_error(begin + "is damaged: its state is not one of this tree", hint);
    return kExitInvalidTree;
  }
  return kExitSuccess;
}

bool KeptRun::begin(Run& run, std::function<void(const std::string& error)> on_error) {
  if (run.fault() != nullptr) return true;
  if (from_) go_on(run);
  writer_.emplace(std::move(file_), CheckpointOptions{.sync = options_.sync(),
                                                      .period = run.period(),
                                                      .real_time = options_.is_real(),
                                                      .on_error = std::move(on_error)});
  const InEngine scope(run.blackboard().lock.get());
  const bool is_good =
      writer_->begin(run.ticker(), facts_, before().ticks, from_ ? from_->resumes + 1 : 0);
  if (!is_good) print_error("--checkpoint: " + printable(writer_->error()));
  return is_good;
}

LoopOptions::Before KeptRun::before() const {
  return from_ ? LoopOptions::Before{.ticks = from_->ticks, .time = from_->time, .gap = gap_}
               : LoopOptions::Before{};
}

void KeptRun::go_on(Run& run) {
  const InEngine scope(run.blackboard().lock.get());
  Ticker& ticker = run.ticker();
  ticker.restore(saved_);
  const lockstep_cut told = cut_of(*from_, options_, run.period());
  gap_ = from_seconds(told.gap);
  std::vector<CutLeaf> cut = ticker.cut_leaves();
  for (CutLeaf& leaf : cut) {
    const LeafAtCut& at_cut = tree_.leaves[leaf.place].at_cut;
    leaf.does = at_cut.is_given ? at_cut.otherwise : options_.on_resume;
    const bool has_kept = leaf.place < leaves_.size() && !leaves_[leaf.place].empty();
    if (has_kept) ticker.ask_after_cut(leaf, leaves_[leaf.place], told);
  }
  ticker.go_on_after_cut(cut);
  // After a fault the run ends, whatever the others have answered.
  resumed_ = fmt::format("resumed after {}{}", duration_text(gap_),
                         ticker.faulted() ? "" : what_leaves_do(cut, tree_));
  if (!options_.record.empty())
    resumed_ += fmt::format("; recorded in '{}'", printable(options_.record));
}

std::string KeptRun::error() const {
  if (!writer_ || writer_->error().empty()) return {};
  return fmt::format("the checkpoint has nothing after {}: {}", counted(writer_->kept(), "tick"),
                     printable(writer_->error()));
}

}  // namespace lockstep::host
