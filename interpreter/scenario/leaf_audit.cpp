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
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      look(tick.tick, tick.nodes[leaves_[i].node], calls_.of(i), leaves_[i]);
      for (const RecordedEntry& entry : tick.entries) {
        look_at_output(tick, entry, calls_.of(i), leaves_[i]);
      }
    }
  }
  std::vector<LeafBreach> take() { return std::move(found_); }

 private:
  struct WrittenEntry {
    std::optional<std::uint32_t> slot = {};  // in the tree
    std::vector<NodeIndex> writers = {};     // in the recording
  };

  // An entry that has changed. Where another node may have written it, nothing is known.
  void look_at_output(const RecordedTick& tick, const RecordedEntry& entry,
                      std::span<const RecordedCalls::Call> calls, AuditedLeaf& leaf) {
    const WrittenEntry& written = entries_[entry.entry];
    const bool is_from_before = tick.tick == 0;  // perhaps: a start value
    if (!written.slot || !entry.value || calls.empty() || is_from_before) return;
    const bool is_alone = std::ranges::all_of(written.writers, [&](NodeIndex it) {
      return it == leaf.node || (tick.moments.empty() && !tick.nodes[it].ticked);
    });
    const LeafModel& model = *leaf.model;
    const auto output = std::ranges::find(model.outputs, *written.slot, &LeafModel::Output::slot);
    if (!is_alone || output == model.outputs.end()) return;
    const std::string& key = header_.entries[entry.entry].key;
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
