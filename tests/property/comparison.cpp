#include "property/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/core/value.h"
#include "engine/synchronized.h"
#include "property/plan_document.h"
#include "property/plan_repair.h"
#include "property/reference.h"
#include "property/reference_barrier.h"
#include "support/scripted_run.h"
#include "support/tree_document.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

std::string to_text(const EventLog& events) {
  std::string text;
  for (const Event& event : events)
    text += fmt::format(" {} {}{},", to_string(event.call), event.leaf,
                        event.factor != 0 ? fmt::format(" at {}", event.factor) : "");
  return text;
}

std::string text_of(const EntryWrite& write) {
  const auto* number = std::get_if<double>(&write.value);
  return number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(write.value);
}

class Comparison {
 public:
  Comparison(const Trial& trial, Tree tree)
      : trial_(trial), engine_(std::move(tree), leaves_text(trial.plan)), reference_(trial.plan) {}

  std::string run(Coverage* coverage) {
    for (tick_ = 0; tick_ < trial_.ticks && difference_.empty(); ++tick_) {
      write_entries();
      compare_tick();
      if (coverage != nullptr) coverage->count(engine_);
      if (trial_.halt_every != 0 && tick_ % trial_.halt_every == trial_.halt_every - 1) halt();
      if (reference_.fault()) break;
    }
    if (difference_.empty() && cases().contains(kGoneComesBack)) {
      difference_ = std::string("the law contradicts itself: ") + kGoneComesBack;
    }
    return difference_;
  }
  const std::map<std::string, long>& cases() const { return reference_.cases(); }

 private:
  template <class Value>
  void same(std::string_view what, const Value& engine, const Value& reference) {
    if (engine == reference || !difference_.empty()) return;
    difference_ =
        fmt::format("tick {}: {}: engine {}, reference {}", tick_, what, engine, reference);
  }

  void same_progress(std::string_view what, std::size_t node, double engine, double reference) {
    if (std::abs(engine - reference) < 1e-12) return;
    if (std::isnan(engine) && std::isnan(reference)) return;
    same(fmt::format("{} of node {}", what, node), engine, reference);
  }

  void write_entries() {
    lockstep::host::test::write_entries(engine_, trial_, tick_);
    for (const EntryWrite& it : trial_.writes) {
      if (it.tick == tick_) reference_.write(it.entry, it.value);
    }
  }

  void compare_tick() {
    engine_.events.clear();
    reference_.events.clear();
    const Nanoseconds now = tick_ * from_seconds(trial_.period);
    const Status status = engine_.tick(now);
    const Status expected = reference_.tick(now);
    compare_fault();
    same("root", to_string(status), to_string(expected));
    compare_nodes();
    compare_events();
    if (trial_.watched && !reference_.fault()) compare_progress();
  }

  void compare_fault() {
    const Fault* fault = engine_.ticker().fault();
    same("leaf at fault", fault != nullptr ? static_cast<int>(fault->node) : -1,
         reference_.fault() ? static_cast<int>(*reference_.fault()) : -1);
  }

  void compare_events() {
    if (engine_.events != reference_.events) {
      same("calls", to_text(engine_.events), to_text(reference_.events));
    }
  }

  void compare_nodes() {
    Ticker& ticker = engine_.ticker();
    for (NodeIndex node = 0; node < engine_.tree().nodes.size(); ++node) {
      if (ticker.status(node) != reference_.status(node)) {
        same(fmt::format("status of node {}", node), to_string(ticker.status(node)),
             to_string(reference_.status(node)));
      }
      if (ticker.held(node) != reference_.held(node)) {
        same(fmt::format("held node {}", node), ticker.held(node), reference_.held(node));
      }
      if (reference_.fault()) continue;
      if (ticker.ticked(node) != reference_.ticked(node)) {
        same(fmt::format("ticked node {}", node), ticker.ticked(node), reference_.ticked(node));
      }
      if (reference_.ticked(node)) compare_snapshot(node);
    }
  }

  void compare_snapshot(NodeIndex node) {
    const auto& expected = reference_.snapshot(node);
    if (expected.empty()) return;
    const auto got = child_progress(engine_.ticker(), node);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      same_progress(fmt::format("snapshot {}", i), node, got[i], expected[i]);
    }
  }

  // What an observer would ask. It may meet a fault, and then the run ends.
  void compare_progress() {
    for (NodeIndex node = 0; node < engine_.tree().nodes.size(); ++node) {
      const double engine = engine_.ticker().progress(node);
      const double reference = reference_.progress(node);
      compare_fault();
      if (reference_.fault()) return halt();
      same_progress("progress", node, engine, reference);
    }
  }

  void halt() {
    engine_.events.clear();
    reference_.events.clear();
    engine_.ticker().halt_all();
    reference_.halt();
    compare_fault();
    compare_nodes();
    compare_events();
  }

  const Trial& trial_;
  ScriptedRun engine_;
  Reference reference_;
  int tick_ = 0;
  std::string difference_;
};

// The smallest trial that still fails, by taking away what it can do without.
Trial shrunk(Trial trial) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (Trial& candidate : smaller_trials(trial)) {
      if (difference(candidate).empty()) continue;
      trial = std::move(candidate);
      smaller = true;
      break;
    }
  }
  return trial;
}

std::string writes_text(const Trial& trial) {
  std::string text;
  for (const EntryWrite& it : trial.writes) {
    text += fmt::format(" {}={} before tick {},", it.entry, text_of(it), it.tick);
  }
  return text;
}

}  // namespace

TrialTree tree_of(const Trial& trial) {
  if (!trial.is_document) return {tree_from_text(tree_text(trial.plan)), ""};
  LoadedDocument loaded = tree_from_document(document_text(trial.plan));
  return {std::move(loaded.tree), std::move(loaded.errors)};
}

// Of entries that the tree does not have, nothing.
void write_entries(ScriptedRun& run, const Trial& trial, int tick) {
  for (const EntryWrite& it : trial.writes) {
    const auto slot = std::ranges::find(run.tree().slots, it.entry, &Slot::name);
    if (it.tick != tick || slot == run.tree().slots.end()) continue;
    run.set(it.entry, parse_value(slot->type, text_of(it)).value());
  }
}

std::string difference(const Trial& trial, Coverage* coverage, GroupCoverage* groups) {
  if (!trial.is_document && has_lonely_members(trial.plan)) return "";
  TrialTree made = tree_of(trial);
  if (groups != nullptr) groups->count_tree(made.refused);
  if (!made.tree) return "";
  Comparison comparison(trial, *std::move(made.tree));
  const std::string difference = comparison.run(coverage);
  if (groups != nullptr) groups->count(comparison.cases());
  return difference;
}

std::string report(std::uint64_t seed, const Trial& failing) {
  const Trial trial = shrunk(failing);
  const std::string tree =
      trial.is_document ? "\n" + document_text(trial.plan) : tree_text(trial.plan);
  return fmt::format(
      "seed {0}; again: ./dev property 1 {0}\n  period {1}, halted every {2}, watched {3}\n"
      "  tree: {4}\n  leaves: {5}\n  entries:{6}\n  {7}",
      seed, trial.period, trial.halt_every, trial.watched, tree, leaves_text(trial.plan),
      writes_text(trial), difference(trial));
}

}  // namespace lockstep::host::test
