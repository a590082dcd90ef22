#include "scenario/leaf_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/core/progress.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "scenario/recorded_calls.h"
#include "scenario/script_results.h"

namespace lockstep::host {
namespace {

struct AuditedLeaf {
  NodeIndex node;  // in the recording
  const LeafNode* leaf;
  const LeafModel* model;
  std::int64_t ticks = 0;   // of this activation
  bool knows_begin = true;  // of it
  bool was_held = false;    // after the tick before
  double progress = 0;      // when that hold began, or at the start of that tick
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
      : header_(header),
        tree_(tree),
        most_(most),
        calls_(header, tree),
        before_(header.nodes.size()) {
    for (const auto& [node, leaf] : calls_.leaves()) {
      leaves_.push_back(
          {node, leaf, &models.leaves[static_cast<std::size_t>(leaf - tree.leaves.data())]});
    }
    std::map<std::string, NodeIndex> recorded;
    for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
      recorded[header.nodes[node].path] = node;
    }
    const auto writers_of = writers(tree);
    for (const ShapeEntry& entry : header.entries) {
      WrittenEntry& it = entries_.emplace_back();
      const auto slot = std::ranges::find(tree.slots, entry.key, &Slot::name);
      if (slot == tree.slots.end()) continue;
      it.slot = static_cast<std::uint32_t>(slot - tree.slots.begin());
      for (const NodeIndex node : writers_of[*it.slot]) {
        const auto at = recorded.find(tree.path(node));
        if (at != recorded.end()) it.writers.push_back(at->second);
      }
    }
  }

  void look(const RecordedTick& tick) {
    calls_.take(tick);
    knows_before_ = tick.tick == next_;
    next_ = tick.tick + 1;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      look(tick, calls_.of(i), leaves_[i]);
      for (const RecordedEntry& entry : tick.entries) {
        look_at_output(tick, entry, calls_.of(i), leaves_[i]);
      }
    }
    before_.assign(tick.nodes.begin(), tick.nodes.end());
  }
  std::vector<LeafBreach> take() { return std::move(found_); }

 private:
  struct WrittenEntry {
    std::optional<std::uint32_t> slot = {};  // in the tree
    std::vector<NodeIndex> writers = {};     // in the recording
  };

  // Whether the node has been called in the tick: ticked, halted or paused.
  bool is_called(const RecordedTick& tick, NodeIndex node) const {
    const RecordedState &was = before_[node], &is = tick.nodes[node];
    return is.ticked || !tick.moments.empty() || was.status != is.status || was.held != is.held;
  }

  // An entry that has changed. Where another node or the outside may have written it, nothing is
  // known.
  void look_at_output(const RecordedTick& tick, const RecordedEntry& entry,
                      std::span<const RecordedCalls::Call> calls, AuditedLeaf& leaf) {
    const WrittenEntry& written = entries_[entry.entry];
    // Perhaps a start value, or of a tick that is lost.
    const bool is_from_before = tick.tick == 0 || !knows_before_;
    const bool is_set = std::ranges::find(tick.set, entry.entry) != tick.set.end();
    if (!written.slot || !entry.value || is_from_before || is_set) return;
    const bool is_alone =
        is_called(tick, leaf.node) && std::ranges::all_of(written.writers, [&](NodeIndex it) {
          return it == leaf.node || !is_called(tick, it);
        });
    const LeafModel& model = *leaf.model;
    const auto output = std::ranges::find(model.outputs, *written.slot, &LeafModel::Output::slot);
    if (!is_alone || output == model.outputs.end()) return;
    const std::string& key = header_.entries[entry.entry].key;
    if (calls.empty()) {
      if (!tick.moments.empty() || before_[leaf.node].status != Status::Running) return;
      const bool is_paused = tick.nodes[leaf.node].status == Status::Running;
      add(tick.tick, leaf,
          fmt::format("wrote '{}' when it was {}, a leaf model allows writes in ticks only", key,
                      is_paused ? "held" : "halted"));
      return;
    }
    const auto any = [&](auto is_wanted) { return std::ranges::any_of(calls, is_wanted); };
    const bool has_succeeded =
        any([](const RecordedCalls::Call& it) { return it.status == Status::Success; });
    const bool has_begun = any([](const RecordedCalls::Call& it) { return it.begins; });
    if (model.writes == Writes::OnSuccess && !has_succeeded) {
      add(tick.tick, leaf,
          fmt::format("wrote '{}' without a success, the leaf model has writes=\"success\"", key));
    } else if (model.writes == Writes::AtStart && !has_begun) {
      add(tick.tick, leaf,
          fmt::format("wrote '{}' after its start, the leaf model has writes=\"start\"", key));
    }
    const auto value = parse_value(leaf.leaf->type->parameters[output->port].type, *entry.value);
    if (value && std::ranges::find(output->values, *value) == output->values.end()) {
      add(tick.tick, leaf,
          fmt::format("wrote {} to '{}', which the leaf model does not allow", brief(*entry.value),
                      key));
    }
  }

  void add(std::uint64_t tick, AuditedLeaf& leaf, std::string message) {
    if (leaf.breaches++ >= most_) return;
    found_.push_back({header_.nodes[leaf.node].path, tick, std::move(message)});
  }

  void look(const RecordedTick& tick, std::span<const RecordedCalls::Call> calls,
            AuditedLeaf& leaf) {
    const LeafModel& model = *leaf.model;
    const RecordedState& state = tick.nodes[leaf.node];
    // Progress is that at the start of this tick: after the one before, and a tick without one.
    const double progress = calls_.progress_at(tick, leaf.node, 0),
                 moved = progress - leaf.progress;
    if (leaf.was_held && knows_before_ && !model.drifts() && std::abs(moved) > kProgressEpsilon &&
        leaf.ticks > 0) {
      add(tick.tick, leaf,
          fmt::format(
              "moved from {:g} to {:g} while it was held, the leaf model has held=\"still\"",
              leaf.progress, progress));
    }
    // In a tick of several moments, the hold has begun in the last one.
    const std::size_t moments = tick.moments.moments.size();
    leaf.progress = moments == 0 ? progress : calls_.progress_at(tick, leaf.node, moments - 1);
    leaf.was_held = state.held && tick.moments.rest.empty();
    if (!knows_before_) {  // it may have ended and begun again
      leaf.knows_begin = false;
      leaf.ticks = 0;
    }
    for (const RecordedCalls::Call& call : calls) {
      if (call.begins) {
        leaf.ticks = 0;
        leaf.knows_begin = knows_before_;
      }
      if (may_be_of_script(tree_, model.node, call.status, call.begins)) continue;
      ++leaf.ticks;
      count(tick.tick, call.status, leaf);
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
    const bool is_early = has_result && leaf.knows_begin && leaf.ticks < model.least_ticks;
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
  std::uint64_t next_ = 0;             // tick
  bool knows_before_ = false;          // the line before is that of the tick before
  std::vector<RecordedState> before_;  // after it
  std::vector<WrittenEntry> entries_;  // of the recording
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
