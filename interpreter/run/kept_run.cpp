#include "run/kept_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "base/core/audience.h"
#include "base/core/crc32c.h"
#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/system/boot_id.h"
#include "engine/tree.h"
#include "run/checkpoint/run_bytes.h"
#include "run/cut_text.h"
#include "team/team_run.h"

namespace lockstep::host {
namespace {

constexpr const char* kRemoveFile = "remove the file to start a new run";

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

lockstep_cut cut_of(const Checkpoint& from, const KeepOptions& options, Nanoseconds period) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const Nanoseconds gap =
      std::chrono::seconds(now.tv_sec) + Nanoseconds(now.tv_nsec) - from.written;
  const bool power = from.boot != boot_id();
  const Nanoseconds sync = power ? CheckpointWriter::longest_sync(options.sync) : Nanoseconds(0);
  const std::uint64_t ticks = (CheckpointWriter::pause_of(period) + sync) / period + 2;
  return {.struct_size = sizeof(lockstep_cut),
          .power = power,
          .held = false,
          .on_resume = 0,
          .gap = std::max(to_seconds(gap), 0.0),
          .lost_ticks = options.real_time ? ticks
                        : power           ? UINT64_MAX
                                          : 1};
}

CheckpointFacts facts_of(std::vector<std::pair<std::string, std::string>> identity,
                         const Tree& tree) {
  CheckpointFacts facts{.identity = std::move(identity), .nodes = {}, .is_leaf = {}};
  facts.identity.emplace_back("the nodes and entries", nodes_mark(tree));
  facts.is_leaf.resize(tree.nodes.size());
  for (const LeafNode& leaf : tree.leaves) facts.is_leaf[leaf.node] = 1;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) facts.nodes.push_back(tree.path(node));
  return facts;
}

}  // namespace

std::string fresh_property_text(const std::string& name) {
  return fmt::format("the property '{}' was not checked before the cut: it begins here", name);
}

tl::expected<std::unique_ptr<KeptRun>, NotKept> KeptRun::open(
    KeepOptions options, std::vector<std::pair<std::string, std::string>> identity,
    const Tree& tree) {
  if (const auto entry = entry_for_objects(tree)) {
    return tl::unexpected(NotKept{
        NotKept::Why::Objects,
        {fmt::format("the entry '{}' holds objects, which no checkpoint has", printable(*entry))}});
  }
  std::unique_ptr<KeptRun> kept(new KeptRun(std::move(options), tree));
  kept->facts_ = facts_of(std::move(identity), tree);
  kept->file_ = std::make_unique<CheckpointFile>(kept->options_.file);
  if (!kept->file_->error().empty()) {
    return tl::unexpected(NotKept{NotKept::Why::File, {printable(kept->file_->error())}});
  }
  if (auto refused = kept->options_.resumes ? kept->read() : std::nullopt) {
    return tl::unexpected(std::move(*refused));
  }
  kept->ticks_ = kept->before().ticks;
  return kept;
}

std::optional<NotKept> KeptRun::read() {
  auto kept = read_checkpoint_file(options_.file);
  if (!kept) {
    return NotKept{NotKept::Why::OtherRun, {printable(kept.error().message), kRemoveFile}};
  }
  if (!*kept || (*kept)->checkpoint.kind == Checkpoint::Kind::Ended) return std::nullopt;
  if (auto refused = refuse(**kept)) return refused;
  if ((*kept)->checkpoint.ticks != 0) from_ = std::move((*kept)->checkpoint);
  return std::nullopt;
}

std::optional<NotKept> KeptRun::refuse(const KeptCheckpoint& kept) {
  const auto refused = [&](NotKept::Why why, const std::string& message,
                           std::string hint = kRemoveFile) {
    return NotKept{why, {fmt::format("'{}' {}", printable(options_.file), message), hint}};
  };
  if (kept.checkpoint.kind == Checkpoint::Kind::Lost) {
    return refused(NotKept::Why::OtherRun, fmt::format("has no state of its run after {}: {}",
                                                       counted(kept.checkpoint.ticks, "tick"),
                                                       printable(kept.checkpoint.note)));
  }
  const auto found = differences(kept.facts, facts_);
  if (!found.empty()) {
    const Difference& it = found.front();
    const std::string more =
        found.size() == 1 ? ""
                          : fmt::format(", and {} more", counted(found.size() - 1, "difference"));
    return refused(NotKept::Why::OtherRun,
                   fmt::format("is of another run: {} was {} and is {}{}", printable(it.name),
                               value_text(it.kept), value_text(it.now), more));
  }
  if (kept.checkpoint.resumes >= options_.resume_limit) {
    return refused(NotKept::Why::TooOften,
                   fmt::format("was resumed {} in a row and no leaf has completed",
                               counted(kept.checkpoint.resumes, "time")),
                   fmt::format("{}, or give a larger {}", kRemoveFile,
                               worded("--resume-limit", "resume_limit")));
  }
  if (!read_bytes(kept.checkpoint.run, tree_, saved_, leaves_)) {
    return refused(NotKept::Why::OtherRun, "is damaged: its state is not one of this tree");
  }
  return std::nullopt;
}

std::optional<Problem> KeptRun::begin(Run& run,
                                      std::function<void(const std::string& error)> on_error) {
  if (run.fault() != nullptr) return std::nullopt;
  if (from_) go_on(run);
  if (from_ && team_ != nullptr && !team_->resume_rounds(from_->rounds))
    return Problem{"the checkpoint has no rounds of these teams"};
  if (from_ && properties_ != nullptr) fresh_properties_ = properties_->go_on(from_->properties);
  writer_.emplace(std::move(file_), CheckpointOptions{.sync = options_.sync,
                                                      .period = run.period(),
                                                      .real_time = options_.real_time,
                                                      .team = team_,
                                                      .properties = properties_,
                                                      .on_error = std::move(on_error)});
  const InEngine scope(run.blackboard().lock.get());
  if (writer_->begin(run.ticker(), facts_, before().ticks, from_ ? from_->resumes + 1 : 0,
                     before().set)) {
    return std::nullopt;
  }
  return Problem{printable(writer_->error())};
}

void KeptRun::after_tick(Ticker& ticker, Status status) {
  writer_->after_tick(ticker, ++ticks_, has_ended(status) || ticker.faulted());
}

LoopOptions::Before KeptRun::before() const {
  if (!from_) return {};
  return {.ticks = from_->ticks, .time = from_->time, .gap = gap_, .set = from_->set};
}

void KeptRun::go_on(Run& run) {
  const InEngine scope(run.blackboard().lock.get());
  Ticker& ticker = run.ticker();
  ticker.restore(saved_);
  run.set_now(from_->time);  // until the first tick
  const lockstep_cut told = cut_of(*from_, options_, run.period());
  gap_ = from_seconds(told.gap);
  cut_ = ticker.cut_leaves();
  for (CutLeaf& leaf : cut_) {
    // What another robot does is heard, and never assumed.
    const LeafNode& node = tree_.leaves[leaf.place];
    leaf.does = stands_for_robots(*node.type) ? AfterCut::StartsAgain
                                              : node.at_cut.unasked(options_.on_resume);
    const bool has_kept = leaf.place < leaves_.size() && !leaves_[leaf.place].empty();
    if (has_kept) ticker.ask_after_cut(leaf, leaves_[leaf.place], told);
  }
  ticker.go_on_after_cut(cut_);
  // After a fault the run ends, whatever the others have answered.
  resumed_ = fmt::format("resumed after {}{}", duration_text(gap_),
                         ticker.faulted() ? "" : what_leaves_do(cut_, tree_));
}

std::string KeptRun::error() const {
  if (!writer_ || writer_->error().empty()) return {};
  return fmt::format("the checkpoint has nothing after {}: {}", counted(writer_->kept(), "tick"),
                     printable(writer_->error()));
}

}  // namespace lockstep::host
