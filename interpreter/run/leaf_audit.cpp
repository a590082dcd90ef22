#include "run/leaf_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/core/any_value.h"
#include "base/core/progress.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "run/script_results.h"
#include "team/team_run.h"

namespace lockstep::host {
namespace {

bool may_have(const ResultSet& results, Status status) {
  if (status == Status::Success) return results.success;
  return status == Status::Failure ? results.failure : results.skipped;
}

std::string allowed_ticks(const LeafModel& model) {
  if (model.most_ticks == 0) return fmt::format("{} or more", model.least_ticks);
  const std::string_view late =
      model.answers_late ? ", and one more on the wall clock, since it is of a program" : "";
  if (model.most_ticks == model.least_ticks) return fmt::format("{}{}", model.least_ticks, late);
  return fmt::format("{} to {}{}", model.least_ticks, model.most_ticks, late);
}

// Rising; empty: one of the values is another one.
std::vector<std::int64_t> whole_numbers(const std::vector<Value>& values) {
  std::vector<std::int64_t> numbers;
  for (const Value& it : values) {
    const auto* number = std::get_if<std::int64_t>(&it);
    if (number == nullptr) return {};
    numbers.push_back(*number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

constexpr std::string_view kChanges[] = {"never", "freely", "rises", "falls"};

}  // namespace

LeafAudit::LeafAudit(const Shape& shape, const Tree& tree, const LeafModels& models,
                     const Sources* sources)
    : shape_(shape),
      tree_(tree),
      models_(models),
      sources_(sources),
      calls_(shape, tree),
      before_(shape.nodes.size()),
      facts_(models.facts.size()) {
  std::map<std::string_view, NodeIndex> nodes;
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) nodes[shape.nodes[node].path] = node;
  std::map<std::uint32_t, std::uint32_t> entry_of;  // by slot
  const auto writers_of = writers(tree);
  for (std::uint32_t entry = 0; entry < shape.entries.size(); ++entry) {
    WrittenEntry& it = entries_.emplace_back();
    const auto slot = std::ranges::find(tree.slots, shape.entries[entry].key, &Slot::name);
    if (slot == tree.slots.end()) continue;
    const auto number = static_cast<std::uint32_t>(slot - tree.slots.begin());
    entry_of[number] = entry;
    for (const NodeIndex node : writers_of[number]) {
      const auto at = nodes.find(tree.path(node));
      if (at != nodes.end()) it.writers.push_back(at->second);
    }
  }
  for (const auto& [node, leaf] : calls_.leaves()) {
    const auto number = static_cast<std::size_t>(leaf - tree.leaves.data());
    const LeafModel& model = models.leaves[number];
    Leaf& it = leaves_.emplace_back(Leaf{.node = node,
                                         .leaf = leaf,
                                         .model = &model,
                                         .number = number,
                                         .in_a_tick = reaches_in_a_tick(model),
                                         .while_held = reaches_while_held(model)});
    for (const LeafModel::Output& output : model.outputs) {
      const auto entry = entry_of.find(output.slot);
      // Where a script of the node writes it too, nothing is known of the leaf.
      if (entry == entry_of.end() || assigns_around(tree, leaf->node, output.slot)) continue;
      it.outputs.push_back(
          {.of = &output, .entry = entry->second, .whole = whole_numbers(output.values)});
    }
  }
  const auto first = first_facts(models);
  for (std::size_t i = 0; i < facts_.size(); ++i) facts_[i].is = first[i];
}

AskedOfRun LeafAudit::asked() const {
  AskedOfRun asked{.within = true, .progress_within = true};
  for (const Leaf& it : leaves_) {
    if (it.leaf->type->has_progress) asked.progress.push_back(it.node);
  }
  return asked;
}

void LeafAudit::begin(const Moment& before) {
  calls_.begin(before);
  next_ = 0;  // the tick after a cut does not follow what was before it
  before_.assign(before.activity.begin(), before.activity.end());
  for (std::uint32_t entry = 0; entry < entries_.size(); ++entry) {
    entries_[entry].writes = writes_of(before, entry);
  }
  for (Leaf& it : leaves_) {
    it.is_cut = before.status(it.node) == Status::Running;
    it.knows_begin = !it.is_cut;
    it.ticks = it.open_ticks = 0;
    it.was_held = it.was_ticked = it.is_overdue = it.was_late = false;
  }
}

void LeafAudit::before_tick(const Moment& moment) {
  for (std::uint32_t entry = 0; entry < entries_.size(); ++entry) {
    entries_[entry].is_set = writes_of(moment, entry) != entries_[entry].writes;
  }
}

void LeafAudit::note_fault(NodeIndex node) {
  const auto it = std::ranges::find(leaves_, node, &Leaf::node);
  if (it != leaves_.end()) it->has_fault = true;
}

std::span<const LeafBreach> LeafAudit::after_tick(const Moment& moment,
                                                  std::span<const std::uint32_t> set) {
  found_.clear();
  calls_.take(moment);
  knows_before_ = moment.tick == next_;
  next_ = moment.tick + 1;
  for (const std::uint32_t entry : set) entries_[entry].is_set = true;
  for (KnownFact& it : facts_) it.is = knows_before_ ? it.is : FactState::Unknown;
  if (!facts_.empty()) take_sets();
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    if (stands_for_robots(*leaves_[i].leaf->type)) continue;  // it does what its robot does
    look(moment, calls_.of(i), leaves_[i]);
    if (!leaves_[i].outputs.empty()) look_at_outputs(moment, calls_.of(i), leaves_[i]);
  }
  if (!facts_.empty()) end_facts();
  for (std::uint32_t entry = 0; entry < entries_.size(); ++entry) {
    entries_[entry].writes = writes_of(moment, entry);
    entries_[entry].is_set = false;
  }
  before_.assign(moment.activity.begin(), moment.activity.end());
  return found_;
}

std::uint32_t LeafAudit::writes_of(const Moment& moment, std::uint32_t entry) const {
  return moment.live != nullptr ? moment.entries[entry].changes() : moment.texts[entry].writes;
}

// Whether the node has been called in the tick: ticked, halted or paused.
bool LeafAudit::is_called(const Moment& moment, NodeIndex node) const {
  return moment.ticked(node) || !moment.within.empty() || before_[node] != moment.activity[node];
}

// --- what a leaf writes --------------------------------------------------------------------------

// The text of a recording may be too long to be there: then it counts as no change.
void LeafAudit::compare(const Moment& moment, const Leaf& leaf, Output& output) const {
  output.has_changed = false;
  if (writes_of(moment, output.entry) == entries_[output.entry].writes) return;
  const auto which = [&](const Value& value) -> std::optional<std::size_t> {
    if (const auto* number = std::get_if<std::int64_t>(&value); number && !output.whole.empty()) {
      const auto at = std::ranges::lower_bound(output.whole, *number);
      if (at == output.whole.end() || *at != *number) return std::nullopt;
      return static_cast<std::size_t>(at - output.whole.begin());
    }
    const auto at = std::ranges::find(output.of->values, value);
    if (at == output.of->values.end()) return std::nullopt;
    return static_cast<std::size_t>(at - output.of->values.begin());
  };
  std::optional<Value> read;
  const Value* value = nullptr;
  const auto take = [&](const std::string& text) {
    const Parameter& port = leaf.leaf->type->parameters[output.of->port];
    read = value_from_outside(port.is_generic, port.type, text);
    if (read) value = &*read;
  };
  if (moment.live == nullptr) {
    const auto& text = moment.texts[output.entry].text;
    if (!text) return;
    take(*text);
  } else {
    const Entry& entry = moment.entries[output.entry];
    if (!entry.has_value()) return;
    const bool is_same_type = entry.value().index() == output.of->values.front().index();
    is_same_type ? void(value = &entry.value()) : take(to_text(entry.value()));
  }
  const std::optional<std::size_t> now = value != nullptr ? which(*value) : std::nullopt;
  output.is_allowed = now || value == nullptr;  // of another type: nothing is known
  output.has_changed = !now || now != output.last;
  output.last = now;
}

// Entries that have changed. Where another node or the outside may have written one, nothing is
// known.
void LeafAudit::look_at_outputs(const Moment& moment, std::span<const LeafCalls::Call> calls,
                                Leaf& leaf) {
  const LeafModel& model = *leaf.model;
  for (Output& output : leaf.outputs) {
    compare(moment, leaf, output);
    const WrittenEntry& written = entries_[output.entry];
    // Perhaps a start value, or of a tick that is lost.
    const bool is_from_before = moment.tick == 0 || !knows_before_;
    if (!output.has_changed || is_from_before || written.is_set) continue;
    const bool is_alone =
        is_called(moment, leaf.node) && std::ranges::all_of(written.writers, [&](NodeIndex it) {
          return it == leaf.node || !is_called(moment, it);
        });
    if (!is_alone) continue;
    const std::string& key = shape_.entries[output.entry].key;
    if (calls.empty()) {
      if (!moment.within.empty() || status_of(before_[leaf.node]) != Status::Running) continue;
      const bool is_paused = moment.status(leaf.node) == Status::Running;
      add(leaf, Assumption::Writes,
          fmt::format("wrote '{}' when it was {}, a leaf model allows writes in ticks only", key,
                      is_paused ? "held" : "halted"));
      continue;
    }
    const auto any = [&](auto is_wanted) { return std::ranges::any_of(calls, is_wanted); };
    const bool has_succeeded =
        any([](const LeafCalls::Call& it) { return it.status == Status::Success; });
    const bool has_begun = any([](const LeafCalls::Call& it) { return it.begins; });
    if (model.writes == Writes::OnSuccess && !has_succeeded) {
      add(leaf, Assumption::Writes,
          fmt::format("wrote '{}' without a success, the leaf model has writes=\"success\"", key));
    } else if (model.writes == Writes::AtStart && !has_begun && !leaf.has_just_begun) {
      add(leaf, Assumption::Writes,
          fmt::format("wrote '{}' after its start, the leaf model has writes=\"start\"", key));
    }
    if (!output.is_allowed) {
      const std::string value = moment.live != nullptr
                                    ? to_text(moment.entries[output.entry].value())
                                    : *moment.texts[output.entry].text;
      add(leaf, Assumption::Outputs,
          fmt::format("wrote {} to '{}', which the leaf model does not allow", brief(value), key));
    }
  }
}

// --- facts ---------------------------------------------------------------------------------------

void LeafAudit::take_sets() {
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const LeafModel& model = *leaves_[i].model;
    if (model.sets.empty()) continue;
    for (const LeafCalls::Call& call : calls_.of(i)) {
      if (may_be_of_script(tree_, model.node, call.status, call.begins)) continue;
      for (const LeafModel::Set& it : model.sets) {
        if (call.status != (it.by_failure ? Status::Failure : Status::Success)) continue;
        (it.value ? facts_[it.fact].set_true : facts_[it.fact].set_false) = true;
      }
    }
  }
}

// A fact that is set in the same tick may be read before or after that.
void LeafAudit::read(const Leaf& leaf, Status status) {
  if (status != Status::Success && status != Status::Failure) return;
  const bool value = status == Status::Success;
  const Fact& fact = models_.facts[leaf.model->fact];
  KnownFact& known = facts_[leaf.model->fact];
  if (value ? known.set_true : known.set_false) return;
  const bool is_set = known.set_true || known.set_false;
  if (!is_set && known.read && *known.read != value) {
    add(leaf, Assumption::Fact,
        fmt::format("had the result {}, but '{}' has read the opposite of the fact '{}' in the "
                    "same tick",
                    to_string(status), shape_.nodes[known.reader].path, fact.name));
  }
  known.read = value;
  known.reader = leaf.node;
  if (known.is == FactState::Unknown || (known.is == FactState::True) == value) return;
  if (fact.changes == (value ? Changes::Rises : Changes::Falls)) return;
  add(leaf, Assumption::Fact,
      fmt::format(
          "had the result {}, but the fact '{}' was {}, and the leaf model has changes=\"{}\"",
          to_string(status), fact.name, value ? "false" : "true",
          kChanges[static_cast<std::size_t>(fact.changes)]));
}

void LeafAudit::end_facts() {
  const auto state = [](bool value) { return value ? FactState::True : FactState::False; };
  for (std::size_t i = 0; i < facts_.size(); ++i) {
    KnownFact& it = facts_[i];
    const bool is_set = it.set_true || it.set_false;
    if (is_set) {
      it.is = it.set_true && it.set_false ? FactState::Unknown : state(it.set_true);
    } else if (it.read) {
      it.is = state(*it.read);
    }
    if (models_.facts[i].changes == Changes::Freely) it.is = FactState::Unknown;
    it.read.reset();
    it.set_true = it.set_false = false;
  }
}

// --- results, ticks and progress -----------------------------------------------------------------

void LeafAudit::look(const Moment& moment, std::span<const LeafCalls::Call> calls, Leaf& leaf) {
  // Progress is that at the start of this tick: after the one before, and a tick without one.
  const double progress = calls_.progress_at(moment, leaf.node, 0);
  if (knows_before_ && leaf.ticks > 0) look_at_progress(progress, leaf);
  leaf.progress = progress;
  leaf.was_held = moment.held(leaf.node) && moment.within.rest.empty();
  if (!knows_before_) {  // it may have ended and begun again
    leaf.knows_begin = false;
    leaf.ticks = leaf.open_ticks = 0;
  }
  const bool is_alone = calls.size() == 1 && moment.within.empty();
  bool is_open = false;
  leaf.has_just_begun = false;
  for (const LeafCalls::Call& call : calls) {
    if (call.begins) {
      leaf.ticks = leaf.open_ticks = 0;
      if (knows_before_) leaf.progress = 0;  // else it may have run before
      leaf.is_overdue = leaf.was_late = false;
      leaf.knows_begin = knows_before_;
    }
    if (may_be_of_script(tree_, leaf.model->node, call.status, call.begins)) continue;
    ++leaf.ticks;
    // A program has not answered in the first tick, and a second time in a tick of the tree.
    const bool answers_late = leaf.model->answers_late;
    if (answers_late && (std::exchange(is_open, true) || leaf.ticks == 1)) ++leaf.open_ticks;
    leaf.has_just_begun = answers_late && leaf.ticks - leaf.open_ticks <= 1;
    if (std::exchange(leaf.is_cut, false)) continue;
    if (leaf.has_fault && call.status == Status::Failure) continue;
    count(leaf, call.status, is_alone);
  }
  // In a tick of several moments, the hold has begun in the last one.
  if (const std::size_t moments = moment.within.moments.size(); moments > 0) {
    leaf.progress = calls_.progress_at(moment, leaf.node, moments - 1);
  }
  leaf.was_ticked = is_alone && moment.activity[leaf.node] == Activity::Running;
  if (moment.status(leaf.node) == Status::Running) return;
  leaf.ticks = leaf.open_ticks = 0;
  leaf.has_fault = false;
}

void LeafAudit::look_at_progress(double progress, Leaf& leaf) {
  const LeafModel& model = *leaf.model;
  const bool has_moved = std::abs(progress - leaf.progress) > kProgressEpsilon;
  if (!has_moved || (!leaf.was_held && !leaf.was_ticked)) return;
  // It has done its work, and waits for the disk.
  if (leaf.leaf->at_cut.commits && !leaf.was_held && progress >= 1.0) return;
  const auto say = [&](Assumption what, std::string_view how) {
    add(leaf, what, fmt::format("moved from {:g} to {:g} {}", leaf.progress, progress, how));
  };
  if (leaf.was_held && !model.drifts())
    return say(Assumption::Held, "while it was held, the leaf model has held=\"still\"");
  if (!model.has_progress) return;
  const LevelReach& reach =
      (leaf.was_held ? leaf.while_held : leaf.in_a_tick)[model.level_of(leaf.progress)];
  const auto level = static_cast<std::int32_t>(model.level_of(progress));
  if (level >= reach.first && level <= reach.last) return;
  if (leaf.was_held)
    return say(Assumption::Held, "while it was held, which the leaf model does not allow");
  say(Assumption::Step, "in a tick, which the leaf model does not allow");
}

void LeafAudit::count(Leaf& leaf, Status status, bool is_alone) {
  const LeafModel& model = *leaf.model;
  const bool has_result = has_ended(status);
  if (model.fact != kNoFact && status != Status::Skipped) {
    read(leaf, status);
  } else if (has_result && !may_have(model.results, status)) {
    add(leaf, Assumption::Result,
        fmt::format("had the result {}, which the leaf model does not allow", to_string(status)));
  }
  const bool may_succeed =
      model.results.success &&
      (!model.has_progress || leaf.in_a_tick[model.level_of(leaf.progress)].may_succeed);
  // A leaf that cannot run ends in one tick, and one that cannot end as it may goes on.
  const bool is_early =
      has_result && model.can_run && leaf.knows_begin && leaf.ticks < model.least_ticks;
  const std::int64_t ticks = leaf.ticks - leaf.open_ticks;
  const bool is_late = std::exchange(leaf.is_overdue, false) && ticks > model.most_ticks;
  const bool may_end = model.fact != kNoFact || model.results.failure || model.results.skipped ||
                       (may_succeed && (is_alone || !model.has_progress));
  // Where its success waits for the disk, it is Running without a call.
  leaf.is_overdue = model.most_ticks != 0 && ticks >= model.most_ticks && may_end &&
                    status == Status::Running && !leaf.was_late && !leaf.leaf->at_cut.commits;
  leaf.was_late |= is_late;
  if (is_early) {
    add(leaf, Assumption::Ticks,
        fmt::format("took {}, the leaf model allows {}",
                    counted(static_cast<std::uint64_t>(leaf.ticks), "tick"), allowed_ticks(model)));
  } else if (is_late) {
    add(leaf, Assumption::Ticks,
        fmt::format("takes more than {}, the leaf model allows {}",
                    counted(static_cast<std::uint64_t>(model.most_ticks + leaf.open_ticks), "tick"),
                    allowed_ticks(model)));
  }
  const bool is_known = is_alone && leaf.knows_begin && model.has_progress;
  if (status == Status::Success && is_known && model.results.success && !may_succeed) {
    add(leaf, Assumption::Finish,
        fmt::format("succeeded from progress {:g}, but the leaf model has finish=\"full\" and a "
                    "step that does not reach 1 from there",
                    leaf.progress));
  }
}

void LeafAudit::add(const Leaf& leaf, Assumption what, std::string message) {
  found_.push_back({leaf.node, std::move(message) + place(leaf, what)});
}

std::string LeafAudit::place(const Leaf& leaf, Assumption what) const {
  const SaidBy& by = models_.said[leaf.number][static_cast<std::size_t>(what)];
  if (by.who == SaidBy::Who::Plugin)
    return fmt::format(" (plugin '{}' declares it)", leaf.leaf->type->plugin);
  if (by.who == SaidBy::Who::Default || sources_ == nullptr)
    return " (assumed of each leaf without a row)";
  const SourceLocation at = sources_->locate(by.place);
  return fmt::format(" ({}:{})", at.file, at.line);
}

}  // namespace lockstep::host
