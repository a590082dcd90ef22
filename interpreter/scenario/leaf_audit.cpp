#include "scenario/leaf_audit.h"

#include <fmt/format.h>

#include <cmath>

#include "base/core/progress.h"
#include "base/core/wording.h"
#include "scenario/recorded_calls.h"
#include "scenario/script_results.h"

namespace lockstep::host {
namespace {

struct AuditedLeaf {
  NodeIndex node;  // in the recording
  const LeafModel* model;
  std::int64_t ticks = 0;  // of this activation
  bool was_held = false;   // after the tick before
  double progress = 0;     // before it
  std::size_t breaches = 0;
};

bool may_have(const ResultSet& results, Status status) {
  if (status == Status::Success) return results.success;
  return status == Status::Failure ? results.failure : results.skipped;
}

std::string allowed_ticks(const LeafModel& model) {
  if (model.most_ticks == 0) return fmt::format("{} or more", model.least_ticks);
  if (model.most_ticks == model.least_ticks) return fmt::format("{}", model.least_ticks);
  return fmt::format("{} to {}", model.least_ticks, model.most_ticks);
}

class Auditor {
 public:
  Auditor(const RecordingHeader& header, const Tree& tree, const LeafModels& models,
          std::size_t most)
      : header_(header), tree_(tree), most_(most), calls_(header, tree) {
    for (const auto& [node, leaf] : calls_.leaves()) {
      leaves_.push_back(
          {node, &models.leaves[static_cast<std::size_t>(leaf - tree.leaves.data())]});
    }
  }

  void look(const RecordedTick& tick) {
    calls_.take(tick);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      look(tick.tick, tick.nodes[leaves_[i].node], calls_.of(i), leaves_[i]);
    }
  }
  std::vector<LeafBreach> take() { return std::move(found_); }

 private:
  void add(std::uint64_t tick, AuditedLeaf& leaf, std::string message) {
    if (leaf.breaches++ >= most_) return;
    found_.push_back({header_.nodes[leaf.node].path, tick, std::move(message)});
  }

  void look(std::uint64_t tick, const RecordedState& state,
            std::span<const RecordedCalls::Call> calls, AuditedLeaf& leaf) {
    const LeafModel& model = *leaf.model;
    // Progress is that at the start of this tick: after the one before, and a tick without one.
    const double moved = state.progress - leaf.progress;
    if (leaf.was_held && !model.drifts() && std::abs(moved) > kProgressEpsilon && leaf.ticks > 0) {
      add(tick, leaf,
          fmt::format(
              "moved from {:g} to {:g} while it was held, the leaf model has held=\"still\"",
              leaf.progress, state.progress));
    }
    leaf.progress = state.progress;
    leaf.was_held = state.held;
    for (const RecordedCalls::Call& call : calls) {
      if (call.begins) leaf.ticks = 0;
      if (may_be_of_script(tree_, model.node, call.status, call.begins)) continue;
      ++leaf.ticks;
      count(tick, call.status, leaf);
    }
    if (state.status != Status::Running) leaf.ticks = 0;
  }

  void count(std::uint64_t tick, Status status, AuditedLeaf& leaf) {
    const LeafModel& model = *leaf.model;
    const bool has_result = has_ended(status);
    if (has_result && !may_have(model.results, status)) {
      add(tick, leaf,
          fmt::format("had the result {}, which the leaf model does not allow", to_string(status)));
    }
    const bool is_early = has_result && leaf.ticks < model.least_ticks;
    const bool is_late = model.most_ticks != 0 && leaf.ticks == model.most_ticks + 1;
    if (is_early) {
      add(tick, leaf,
          fmt::format("took {}, the leaf model allows {}",
                      counted(static_cast<std::uint64_t>(leaf.ticks), "tick"),
                      allowed_ticks(model)));
    } else if (is_late) {
      add(tick, leaf,
          fmt::format("takes more than {}, the leaf model allows {}",
                      counted(static_cast<std::uint64_t>(model.most_ticks), "tick"),
                      allowed_ticks(model)));
    }
  }

  const RecordingHeader& header_;
  const Tree& tree_;
  const std::size_t most_;
  RecordedCalls calls_;
  std::vector<AuditedLeaf> leaves_;
  std::vector<LeafBreach> found_;
};

}  // namespace

std::vector<LeafBreach> audit_leaves(RecordingReader& reader, const Tree& tree,
                                     const LeafModels& models, std::size_t most) {
  Auditor auditor(reader.header(), tree, models, most);
  while (const auto tick = reader.next()) auditor.look(*tick);
  return auditor.take();
}

}  // namespace lockstep::host
