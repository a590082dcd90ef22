#include "scenario/recorded_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/core/any_value.h"
#include "base/core/deadlines.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "judge/measure/entry_changes.h"
#include "judge/summary/standstills.h"
#include "judge/summary/statistics.h"
#include "language/document/well_formed.h"
#include "record/read/recorded_moments.h"
#include "record/read/recording_parts.h"
#include "record/read/recording_reader.h"
#include "run/leaf_calls.h"
#include "run/script_results.h"
#include "scenario/ended_results.h"
#include "tree/types/literal.h"

namespace lockstep::host {
namespace {

// The ticks that took so long that deadlines were skipped. One that is late by less than a period
// has the place of its deadline.
class SkippedDeadlines {
 public:
  explicit SkippedDeadlines(double rate) : deadlines_(rate) {}

  // Returns how many there were before the tick.
  std::uint64_t add(const RecordedTick& tick, std::vector<RecordedWords::Late>& late) {
    const std::uint64_t passed =
        deadlines_.first_from(from_seconds(tick.time) + Nanoseconds(1)) - 1;
    if (!last_) {
      first_ = passed;  // the scenario begins with it
      last_ = {tick.tick, 0};
      return 0;
    }
    const std::uint64_t place = passed - first_;
    const std::uint64_t expected = last_->place + (tick.tick - last_->tick);
    const std::uint64_t skipped = place > expected ? place - expected : 0;
    if (skipped > 0) {
      const std::uint64_t until = last_->place + 1 + skipped;
      late.push_back({last_->tick, deadlines_.at(until) - deadlines_.at(last_->place)});
    }
    last_ = {tick.tick, expected + skipped};
    return skipped;
  }

 private:
  struct Tick {
    std::uint64_t tick, place;
  };
  const Deadlines deadlines_;
  std::uint64_t first_ = 0;
  std::optional<Tick> last_;
};

// The leaves of a tree as a recording has them.
class WordMaker {
 public:
  WordMaker(const RecordingHeader& header, const Tree& tree, RecordedWords& words)
      : header_(header),
        tree_(tree),
        words_(words),
        results_(header, tree),
        calls_(header, tree),
        moments_(header),
        values_(header.entries.size()),
        before_(header.nodes.size()),
        times_(header.rate_hz) {
    std::map<std::string, NodeIndex> recorded;
    for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
      recorded[header.nodes[node].path] = node;
    }
    for (const auto& [node, leaf] : calls_.leaves()) {
      leaves_.push_back({node, leaf, &words.leaves[header.nodes[node].path]});
    }
    const auto writers_of = writers(tree);
    const bool names_writers =
        std::ranges::any_of(header.entries, [](const auto& it) { return !it.writers.empty(); });
    for (const ShapeEntry& key : header.entries) {
      auto& of_key = writers_.emplace_back();
      auto& by_script = setters_.emplace_back();
      std::string& initial = initial_.emplace_back();
      std::string& start = starts_.emplace_back();
      const auto slot = std::ranges::find(tree.slots, key.key, &Slot::name);
      if (slot == tree.slots.end()) continue;
      initial = to_text(slot->initial);
      start = start_of(*slot, initial);
      // Of a leaf whose plugin is not at hand, only the recording knows what is an output.
      if (names_writers) of_key = key.writers;
      for (const NodeIndex node : writers_of[static_cast<std::size_t>(slot - tree.slots.begin())]) {
        const auto at = recorded.find(tree.path(node));
        if (at == recorded.end()) continue;
        if (names_writers && std::ranges::find(key.writers, at->second) == key.writers.end())
          continue;
        if (!names_writers) of_key.push_back(at->second);
        by_script.push_back({at->second, node, is_script(tree, node)});
      }
    }
  }

  void add(const RecordedTick& tick) {
    const Moment& moment = moments_.read(tick);
    calls_.take(moment);
    skipped_ = header_.rate_hz > 0 ? times_.add(tick, words_.late) : 0;
    if (!tick.moments.rest.empty()) {
      note(Lacks::Moments, "tick {} has more moments than a recording keeps: the leaves do less",
           tick.tick);
    }
    if (!tick.faults.empty()) {
      note(Lacks::Faults,
           "the run continued after the fault in tick {}, as with '--on-fault fail': "
           "the scenario ends with it{}",
           tick.tick,
           may_be_held(tick.faults.front().node) ? ", or with the next tick of a held leaf" : "");
    }
    for (const NodeIndex node : moment.stood_still) {
      note(Lacks::Intervention, "'--stall-fail' ended '{}' in tick {}: the scenario waits on",
           header_.nodes[node].path, tick.tick);
    }
    find_changed(tick);
    missing_ = tick.tick - next_tick_;
    next_tick_ = tick.tick + 1;
    if (missing_ > 0) gaps_.push_back({.ticks = missing_, .from = tick.tick - missing_});
    for (std::size_t i = 0; i < leaves_.size(); ++i) add(tick, moment, calls_.of(i), leaves_[i]);
    for (const RecordedEntry& entry : tick.entries) take_change(tick, entry);
    for (NodeIndex node = 0; node < before_.size(); ++node) before_[node] = tick.nodes[node].status;
  }

  // The fault that has ended the run: "Main/arm: fails as a program". No tick names it, and its
  // node is recorded as running.
  void take_fault(std::string_view fault) {
    for (Leaf& it : leaves_) {
      const std::string& path = header_.nodes[it.node].path;
      if (!fault.starts_with(path + ": ") || it.words->empty()) continue;
      const std::string_view message = fault.substr(path.size() + 2);
      if (message.starts_with(kNotHalted)) {
        note(Lacks::LastHalt,
             "'{}' could not be halted after the last tick: the scenario has no step for that",
             path);
        continue;
      }
      if (it.words->back().status != Status::Running) continue;
      const auto hook = hook_of_fault(tree_, it.leaf->node, message);
      // By an ancestor, after its tick: then it is idle. Or by its own script, before its tick.
      if (hook == Hook::OnHalted && it.before.status != Status::Running) continue;
      const std::uint64_t tick = words_.ticks.value_or(1) - 1;
      if (!it.before.ticked) {
        // The fault did not wait for its tick: it is in the next one that the leaf gets.
        if (hook || it.before.status != Status::Running) continue;
        if (it.before.held) {
          note(Lacks::HeldFault,
               "'{}' had the fault in tick {} while it was held: a scenario has no step for that, "
               "and has it in the next tick of the leaf",
               path, tick);
        }
        it.words->emplace_back();
      }
      take_fault(it, hook, it.begins, tick);
    }
  }

  void finish() {
    note_gaps();
    note_not_recorded();
    leave_out_what_xml_lacks();
    std::erase_if(words_.leaves, [](const auto& it) { return it.second.empty(); });
  }

 private:
  // The line of the first tick has each entry that has a value, also where that was there before.
  void find_changed(const RecordedTick& tick) {
    changed_.assign(header_.entries.size(), false);
    for (const RecordedEntry& it : tick.entries) {
      changed_[it.entry] = tick.tick > 0 || it.value != starts_[it.entry];
      values_[it.entry] = it.value;
    }
  }

  // As a recording has it: of an int, --set "+5" is 5.
  std::string start_of(const Slot& slot, const std::string& initial) const {
    const auto given = header_.values.find(slot.name);
    if (given == header_.values.end()) return initial;
    const auto value = value_from_outside(slot.typing == Typing::Any, slot.type, given->second);
    return value ? to_text(*value) : given->second;
  }

  // Of an entry that was set from outside, what it was set to: the tree may have written it again.
  void take_change(const RecordedTick& tick, const RecordedEntry& entry) {
    const std::string& key = header_.entries[entry.entry].key;
    const bool is_set = std::ranges::find(tick.set, entry.entry) != tick.set.end();
    const bool is_start = tick.tick == 0 && header_.values.contains(key);
    if (!is_set && (is_start || is_of_tree(tick, entry))) return;
    const auto given = std::ranges::find(tick.given, entry.entry, &RecordedEntry::entry);
    const auto& value = given == tick.given.end() ? entry.value : given->value;
    if (!value) return note_too_long(fmt::format("what set '{}' in tick {}", key, tick.tick));
    if (tick.tick == 0 && is_set && !tree_.rules->strict_types) {
      note(
          Lacks::Start,
          "'{}' was set before the first tick: the scenario begins with that value, which may give "
          "the entry another type",
          key);
    }
    if (is_start) std::erase_if(words_.changes, [&](const auto& it) { return it.key == key; });
    words_.changes.push_back({key, *value, tick.tick});
  }

  // Nodes and scripts of the tree write it. The first values may be from elsewhere.
  bool is_of_tree(const RecordedTick& tick, const RecordedEntry& entry) const {
    const auto& writers = writers_[entry.entry];
    const auto is_ticked = [&] {
      return std::ranges::any_of(writers, [&](NodeIndex it) { return tick.nodes[it].ticked; });
    };
    if (tick.tick > 0) return !writers.empty();
    const std::string& initial = initial_[entry.entry];
    const bool is_initial =
        entry.value ? entry.value == initial : initial.size() > EntryChanges::kLongest;
    return is_initial || is_ticked();
  }

  enum class Lacks {
    Moments,
    Faults,
    Value,
    OtherValues,
    TooLong,
    Decision,
    Result,
    LastHalt,
    HeldFault,
    Intervention,
    Start
  };

  // Each once.
  template <class... Args>
  void note(Lacks what, fmt::format_string<Args...> text, Args&&... args) {
    const auto is_new = noted_.insert(what).second;
    if (is_new) words_.notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void note_gaps() {
    if (gaps_.empty()) return;
    words_.lacks_ticks = true;
    std::uint64_t ticks = 0;
    for (const RecordedGap& it : gaps_) ticks += it.ticks;
    const std::string places = gaps_.size() == 1 ? "" : fmt::format(" in {} places", gaps_.size());
    words_.notes.insert(
        words_.notes.begin(),
        fmt::format("{} {} missing{}, from tick {} on: what leaves did there is guessed, and the "
                    "scenario may take more or fewer ticks",
                    counted(ticks, "tick"), ticks == 1 ? "is" : "are", places, gaps_[0].from));
  }

  bool may_be_held(NodeIndex node) const {
    return std::ranges::any_of(path_to_root(header_, node), [this](NodeIndex it) {
      return header_.nodes[it].keeper || header_.nodes[it].group;
    });
  }

  void note_too_long(const std::string& what) {
    note(Lacks::TooLong, "{} is not recorded: the value has more than {} bytes", what,
         EntryChanges::kLongest);
  }

  // The entries that the recording leaves out. Each may have had a start value, or another one that
  // was set, which the recording leaves out too.
  void note_not_recorded() {
    std::vector<std::string_view> lacking;
    for (const Slot& it : tree_.slots) {
      const bool is_there =
          std::ranges::find(header_.entries, it.name, &ShapeEntry::key) != header_.entries.end();
      if (!is_there) lacking.push_back(it.name);
    }
    if (lacking.empty()) return;
    words_.notes.push_back(
        fmt::format("the recording does not have the values of {}: what leaves wrote there, or "
                    "others set, also by --set, is not in the scenario",
                    listed(lacking)));
  }

  // For example, the byte that begins an escape sequence.
  void leave_out_what_xml_lacks() {
    const auto has_it = [&](const std::string& what, const std::string& value) {
      const auto fault = check_encoding(value);
      if (fault) {
        words_.notes.push_back(
            fmt::format("the value of {} is not in the scenario: {}", what, fault->message));
      }
      return !fault.has_value();
    };
    std::erase_if(words_.arguments, [&](const auto& it) {
      return !has_it(fmt::format("the argument '{}'", it.first), it.second);
    });
    std::erase_if(words_.changes, [&](const auto& it) {
      return !has_it(fmt::format("'{}' in tick {}", it.key, it.tick), it.value);
    });
    for (auto& [path, words] : words_.leaves) {
      for (LeafWord& word : words) {
        std::erase_if(word.written, [&](const auto& it) {
          return !has_it(fmt::format("the output '{}' of '{}'", it.first, path), it.second);
        });
      }
    }
  }

  static bool is_script(const Tree& tree, NodeIndex node) {
    const NodeType& type = *tree.labels[node].type;
    return type.leaf == nullptr && std::ranges::any_of(type.parameters, &Parameter::is_script);
  }

  struct Leaf {
    NodeIndex node;
    const LeafNode* leaf;
    std::vector<LeafWord>* words;
    RecordedState before = {};  // in the tick before
    bool begins = false;        // an activation, with its last word
    bool has_after = false;     // that word has what it led to
    std::size_t still = 0;      // ticks that were withheld, since the last word, without a drift
  };

  // Progress is that at the start of a tick: what the tick before has led to. Each tick that was
  // withheld is a word, but those behind which the leaf does not drift any more. One that a tick
  // reached and then held has drifted since, if the recording has what that tick led to.
  void take_progress(double progress, Leaf& it) const {
    const RecordedState& before = it.before;
    if (it.words->empty() || before.status != Status::Running) return;
    LeafWord& last = it.words->back();
    const bool is_of_last = !before.held || (before.ticked && !it.has_after);
    if (is_of_last && last.status == Status::Running && last.kind != LeafWord::Kind::Fault)
      last.progress = progress;
    if (!before.held) return;
    const double held_at = before.ticked ? last.progress : before.progress;
    // These words count periods.
    it.still += std::min(missing_ + skipped_, kMostWords);
    if (progress == held_at) {
      ++it.still;
    } else {
      it.words->insert(it.words->end(), std::exchange(it.still, 0),
                       {.kind = LeafWord::Kind::Held, .progress = held_at});
      it.words->push_back({.kind = LeafWord::Kind::Held, .progress = progress});
    }
  }

  // There is no line of the ticks before this one. What they led to is known: a leaf that ran has
  // moved on, evenly as far as anybody knows, or has a result, which the scenario has in this tick.
  void guess_missing(const RecordedTick& tick, double progress, Leaf& it) {
    const RecordedState &before = it.before, &now = tick.nodes[it.node];
    const bool has_result = has_ended(now.status) && !now.ticked;
    const bool is_there = now.ticked || now.status != Status::Idle;
    const bool ran = before.status == Status::Running && !it.words->empty();
    if (ran && is_there && !before.held && !now.held && missing_ <= kMostWords) {
      const double end = has_result && now.status == Status::Success ? 1 : progress;
      const double step = std::max(end - before.progress, 0.0) / static_cast<double>(missing_ + 1);
      for (std::uint64_t ticks = 1; ticks <= missing_ + 1; ++ticks) {
        const double after = std::min(before.progress + step * static_cast<double>(ticks), 1.0);
        if (ticks > 1) it.words->emplace_back();
        it.words->back().progress = after;
      }
    }
    if (!has_result) {
      if (is_there) take_progress(progress, it);
    } else if (now.status != before.status && !is_left_to_script(it, now.status, !ran, tick.tick)) {
      add_word(tick, it, now.status, 0, true);
    }
  }

  static constexpr std::uint64_t kMostWords = 1000;  // for what has no line

  // A word for each tick that it got.
  void add(const RecordedTick& tick, const Moment& moment, std::span<const LeafCalls::Call> calls,
           Leaf& it) {
    const double progress = calls_.progress_at(moment, it.node, 0);
    missing_ > 0 ? guess_missing(tick, progress, it) : take_progress(progress, it);
    it.before = tick.nodes[it.node];
    it.before.progress = progress;
    if (it.before.ticked) it.still = 0;
    const auto fault = std::ranges::find(tick.faults, it.node, &RecordedFault::node);
    const bool has_fault = fault != tick.faults.end();
    const auto hook =
        has_fault ? hook_of_fault(tree_, it.leaf->node, fault->message) : std::nullopt;
    for (const LeafCalls::Call& call : calls) {
      Status status = tick.moments.empty() ? results_.of(tick, it.node) : call.status;
      if (status == Status::Idle) status = Status::Running;
      it.begins = call.begins;
      const bool is_of_fault = has_fault && hook != Hook::OnHalted && status != Status::Success;
      if (!is_of_fault && is_left_to_script(it, status, call.begins, tick.tick)) continue;
      const double after = call.next ? calls_.progress_at(moment, it.node, *call.next) : progress;
      it.has_after = call.next && !tick.moments.progress.empty();
      add_word(tick, it, status, after, calls.size() == 1);
      if (is_of_fault) take_fault(it, hook, call.begins, tick.tick);
    }
  }

  // Whether a script may have given the leaf this result. Then the leaf has no word for it.
  bool is_left_to_script(const Leaf& it, Status status, bool begins, std::uint64_t tick) {
    if (!may_be_of_script(tree_, it.leaf->node, status, begins)) return false;
    const char step = status == Status::Skipped ? 'K' : status == Status::Failure ? 'F' : 'S';
    note(Lacks::Decision,
         "the {} of '{}' in tick {} may be that of its script or of the leaf itself: the scenario "
         "has it as that of the script. If it is that of the leaf, add the step {}",
         to_string(status), header_.nodes[it.node].path, tick, step);
    return true;
  }

  // The last word of the leaf is of a call with a fault: of the leaf, or of a script of it. Such a
  // script will fault again if the leaf does the same.
  void take_fault(Leaf& it, std::optional<Hook> hook, bool begins, std::uint64_t tick) {
    LeafWord& last = it.words->back();
    if (!hook) {
      last.kind = LeafWord::Kind::Fault;
      return;
    }
    const bool is_before_tick = *hook <= Hook::While || *hook == Hook::OnHalted;
    last.status = *hook == Hook::OnFailure ? Status::Failure : Status::Success;
    last.progress = 0;
    if (*hook == Hook::Post) {
      note(Lacks::Result,
           "'{}' has succeeded or failed in tick {}, before the fault of its script: the scenario "
           "has the step S. If it has failed, write F",
           header_.nodes[it.node].path, tick);
    }
    if (is_before_tick || is_left_to_script(it, last.status, begins, tick)) it.words->pop_back();
  }

  // `progress`: after it; the next tick may tell better. `is_only`: the leaf has no other word for
  // the tick.
  void add_word(const RecordedTick& tick, const Leaf& it, Status status, double progress,
                bool is_only) {
    LeafWord word{.status = status};
    if (status == Status::Running) word.progress = progress;
    add_writes(tick, it, word, is_only);
    it.words->push_back(std::move(word));
  }

  // Whether a script of the tree may have written the entry after the leaf.
  bool is_overwritten(const RecordedTick& tick, std::size_t entry, NodeIndex leaf,
                      std::uint32_t slot) const {
    return std::ranges::any_of(setters_[entry], [&](const Setter& it) {
      const bool is_behind = it.in_tree > leaf;
      const bool is_around = it.in_tree <= leaf && leaf < tree_.nodes[it.in_tree].end;
      if (!tick.nodes[it.node].ticked || !(is_behind || is_around)) return false;
      return (is_behind && it.is_script) ||
             may_be_set_at_end(tree_, it.in_tree, tick.nodes[it.node].status, slot);
    });
  }

  // Whether a node that was halted in this tick may have written the entry: before the leaf or
  // after it.
  bool is_set_by_halt(const RecordedTick& tick, std::size_t entry, std::uint32_t slot) const {
    return std::ranges::any_of(setters_[entry], [&](const Setter& it) {
      const bool has_run = tick.nodes[it.node].ticked || before_[it.node] == Status::Running;
      return has_run && tick.nodes[it.node].status == Status::Idle &&
             host::is_set_by_halt(tree_, it.in_tree, slot);
    });
  }

  // Whether the entry may have had another value in this tick, until the leaf wrote it.
  bool is_put_back(const RecordedTick& tick, std::uint32_t entry, const Leaf& leaf,
                   std::uint32_t slot, bool is_only) const {
    if (std::ranges::find(tick.set, entry) != tick.set.end()) return true;
    return std::ranges::any_of(setters_[entry], [&](const Setter& it) {
      if (!tick.nodes[it.node].ticked || it.node == leaf.node) return false;
      if (it.in_tree >= leaf.leaf->node && is_only) return false;
      return it.is_script || tree_.labels[it.in_tree].type->leaf != nullptr ||
             may_be_set_at_end(tree_, it.in_tree, tick.nodes[it.node].status, slot);
    });
  }

  // Whether another leaf may have written the entry after it.
  bool is_shared(const RecordedTick& tick, std::size_t entry, NodeIndex leaf) const {
    return std::ranges::any_of(setters_[entry], [&](const Setter& it) {
      return it.in_tree > leaf && tree_.labels[it.in_tree].type->leaf != nullptr &&
             tick.nodes[it.node].ticked;
    });
  }

  // Its ports that write an entry, and the slots of these.
  template <class Look>
  void each_output(const Leaf& it, Look look) const {
    const auto& parameters = it.leaf->type->parameters;
    for (std::size_t port = 0; port < parameters.size(); ++port) {
      const std::uint32_t slot = tree_.ports[it.leaf->first_port + port].slot;
      if (slot == PortBinding::kUnbound || parameters[port].direction == Direction::Input) continue;
      look(parameters[port], slot);
    }
  }

  // Entries that have changed in a tick of a leaf that may write them.
  void add_writes(const RecordedTick& tick, const Leaf& it, LeafWord& word, bool is_only) {
    for (const RecordedEntry& entry : tick.entries) {
      const ShapeEntry& key = header_.entries[entry.entry];
      const auto& writers = writers_[entry.entry];
      const bool is_writer = std::ranges::find(writers, it.node) != writers.end();
      if (!is_writer || !changed_[entry.entry]) continue;
      each_output(it, [&](const Parameter& port, std::uint32_t slot) {
        if (tree_.slots[slot].name != key.key) return;
        const std::string& path = header_.nodes[it.node].path;
        if (is_overwritten(tick, entry.entry, it.leaf->node, slot)) {
          note(Lacks::Value,
               "a script wrote '{}' in tick {} after '{}': what this leaf writes is "
               "not recorded",
               key.key, tick.tick, path);
        } else if (!entry.value) {
          note_too_long(
              fmt::format("what '{}' wrote to '{}' in tick {}", path, key.key, tick.tick));
        } else if (is_value_of(port, *entry.value)) {
          word.written.emplace_back(port.name, *entry.value);
          const bool is_told = is_only && !is_shared(tick, entry.entry, it.leaf->node) &&
                               !is_set_by_halt(tick, entry.entry, slot) &&
                               !(is_text_of_number(port, slot, *entry.value) &&
                                 is_put_back(tick, entry.entry, it, slot, is_only));
          if (is_told) return;
          note(Lacks::OtherValues,
               "'{}' may have been written several times in tick {}: only its last value is "
               "recorded, and '{}' writes that",
               key.key, tick.tick, path);
        }
      });
    }
    add_same(tick, it, word, is_only);
  }

  // In a tree for BehaviorTree.CPP, the entry may have what a script has written, which is no value
  // of the port.
  static bool is_value_of(const Parameter& port, const std::string& text) {
    return port.type == ValueType::Object || parse_value(port.type, text).has_value();
  }

  // A recording has the same text for 0 and '0'. In a tree for BehaviorTree.CPP, only one of them
  // can be followed by n := 1. So it matters whether a script has written it, or the leaf has.
  bool is_text_of_number(const Parameter& port, std::uint32_t slot, const std::string& text) const {
    return port.type == ValueType::String && tree_.slots[slot].typing != Typing::Strict &&
           literal_type(text) != ValueType::String;
  }

  // Entries that have changed and have their value again. A leaf may have put it back: found :=
  // false, and the leaf finds it. Or a script has after it.
  void add_same(const RecordedTick& tick, const Leaf& it, LeafWord& word, bool is_only) {
    each_output(it, [&](const Parameter& port, std::uint32_t slot) {
      const auto key = std::ranges::find(header_.entries, tree_.slots[slot].name, &ShapeEntry::key);
      if (key == header_.entries.end()) return;
      const auto entry = static_cast<std::uint32_t>(key - header_.entries.begin());
      if (changed_[entry]) return;
      if (!is_overwritten(tick, entry, it.leaf->node, slot)) {
        const auto& value = values_[entry];
        const bool may_be =
            value && is_value_of(port, *value) && is_put_back(tick, entry, it, slot, is_only);
        if (may_be) word.written.emplace_back(port.name, *value);
        return;
      }
      note(Lacks::Value,
           "a script wrote '{}' in tick {} after '{}', and it has the value that it had: what this "
           "leaf writes is not recorded",
           key->key, tick.tick, header_.nodes[it.node].path);
    });
  }

  const RecordingHeader& header_;
  const Tree& tree_;
  RecordedWords& words_;
  const EndedResults results_;
  LeafCalls calls_;
  RecordedMoments moments_;
  std::vector<Leaf> leaves_;
  std::vector<std::vector<NodeIndex>> writers_;  // of each entry: nodes of the recording
  struct Setter {
    NodeIndex node, in_tree;
    bool is_script;  // as its parameter says, not around its ticks
  };
  std::vector<std::vector<Setter>> setters_;        // of each entry
  std::vector<std::optional<std::string>> values_;  // of each entry: the last that is known
  std::vector<bool> changed_;                       // of each entry: in this tick
  std::vector<Status> before_;                      // of each node, after the tick before
  SkippedDeadlines times_;
  std::uint64_t next_tick_ = 0;
  std::uint64_t missing_ = 0, skipped_ = 0;  // ticks and deadlines, before the tick
  std::vector<RecordedGap> gaps_;
  std::set<Lacks> noted_;
  // Of each entry: what the tree gives it, and what it had before the first tick.
  std::vector<std::string> initial_, starts_;
};

// The nodes of the language that are about a time, such as a Timeout.
std::vector<NodeIndex> timed_nodes(const Tree& tree) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const NodeType& type = *tree.labels[node].type;
    if (type.leaf != nullptr || type.parameters.empty()) continue;
    const Parameter& first = type.parameters.front();
    // A WaitUntil may have no timeout.
    const bool has_time = first.required || tree.nodes[node].kind->reads_entries ||
                          tree.cells[tree.nodes[node].params].number != 0;
    if (has_time && (first.unit == "s" || first.unit == "ms")) nodes.push_back(node);
  }
  return nodes;
}

// How often nodes began to run.
class BegunNodes {
 public:
  BegunNodes(const RecordingHeader& header, const Tree& tree, std::span<const NodeIndex> nodes) {
    std::set<std::string> paths;
    for (const NodeIndex node : nodes) paths.insert(tree.path(node));
    for (NodeIndex it = 0; it < header.nodes.size(); ++it) {
      if (paths.contains(header.nodes[it].path)) nodes_.push_back({it});
    }
  }

  void add(const RecordedTick& tick) {
    for (Node& it : nodes_) {
      const bool runs = tick.nodes[it.node].status == Status::Running;
      if (runs && !it.runs) ++count_;
      it.runs = runs;
    }
  }
  std::uint64_t count() const { return count_; }

 private:
  struct Node {
    NodeIndex node;
    bool runs = false;
  };
  std::vector<Node> nodes_;
  std::uint64_t count_ = 0;
};

}  // namespace

RecordedWords read_recorded_words(const std::string& path, const Tree& tree) {
  RecordedWords words;
  NamedRecording file(path);
  if (!file.is_open()) {
    words.outcome.error = fmt::format("'{}' cannot be read: {}", path, std::strerror(errno));
    return words;
  }
  RecordingReader reader(file.text(), path);
  if (reader.error().empty()) {
    const RecordingHeader& header = reader.header();
    if (header.first_tick > 0) {
      words.outcome.error =
          fmt::format("'{}' begins with tick {}: a scenario needs the begin of the run", path,
                      header.first_tick);
      return words;
    }
    words.tree_file = header.file;
    words.tick = header.tick;
    words.arguments = header.arguments;
    for (const auto& [key, value] : header.values) words.changes.push_back({key, value, 0});
    words.rate = header.rate_hz > 0 ? std::optional(header.rate_hz) : std::nullopt;
    WordMaker maker(header, tree, words);
    const auto timed = header.clock == "wall" ? timed_nodes(tree) : std::vector<NodeIndex>();
    BegunNodes begun(header, tree, timed);
    std::uint64_t ticks = 0;
    while (const auto tick = reader.next()) {
      maker.add(*tick);
      begun.add(*tick);
      ticks = tick->tick + 1;
    }
    words.ticks = ticks;
    if (ticks == 0 && reader.outcome().error.empty()) {
      words.outcome.error = fmt::format("'{}' has no tick: a scenario needs one", path);
      return words;
    }
    if (reader.end()) {
      words.result = reader.end()->result;
      // With --overrun catch-up, late ticks come one right after the other.
      if (reader.end()->skipped == 0 && reader.resumes().empty()) words.late.clear();
      maker.take_fault(reader.end()->fault);
    }
    maker.finish();
    words.spare_ticks = begun.count();
    if (!timed.empty()) {
      words.notes.push_back(
          fmt::format("the run was on the wall clock, on which '{}' may take a tick more than here",
                      tree.path(timed.front())));
    }
  }
  words.outcome = reader.outcome();
  return words;
}

}  // namespace lockstep::host
