#include "leaves/plugin/contract/descriptor_behavior.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/behavior.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "leaves/plugin/contract/descriptor_port.h"

namespace lockstep::host {
namespace {

std::optional<Problem> check_output(const Behavior::Named& output,
                                    std::span<const Parameter> ports) {
  const auto port = std::ranges::find(ports, output.name, &Parameter::name);
  if (port == ports.end() || port->direction == Direction::Input) {
    std::vector<std::string_view> known;
    for (const Parameter& it : ports) {
      if (it.direction != Direction::Input) known.push_back(it.name);
    }
    return Problem{fmt::format("has no output '{}'", brief(output.name)),
                   suggest(output.name, known, "its outputs")};
  }
  std::string_view rest = output.text;
  while (true) {
    const std::string_view part = rest.substr(0, rest.find('|'));
    if (!parse_value(port->type, part)) {
      return Problem{fmt::format("has '{}', which is not a value of '{}'", brief(part), port->name),
                     fmt::format("expected {}", expected_text(port->type))};
    }
    if (part.size() == rest.size()) return std::nullopt;
    rest.remove_prefix(part.size() + 1);
  }
}

// A statement that the rest of the descriptor denies.
std::optional<Problem> check_against(const lockstep_leaf_type& leaf, const Behavior& behavior) {
  const bool can_run = leaf.kind == LOCKSTEP_CONDITION ? (leaf.flags & LOCKSTEP_MAY_RUN) != 0
                                                       : (leaf.flags & LOCKSTEP_AT_ONCE) == 0;
  if (!can_run && behavior.ticks && behavior.ticks != WholeRange{1, 1}) {
    return Problem{"has more than one tick, but the leaf never runs", "leave 'ticks' out"};
  }
  const bool moves = behavior.progress && behavior.progress->kind != ProgressWay::Kind::None;
  const bool drifts = behavior.held && *behavior.held != WholeRange{0, 0};
  if (leaf.progress == nullptr && (moves || behavior.step || behavior.finishes_full || drifts)) {
    return Problem{"is about progress, but the leaf has no progress function",
                   "leave out 'progress', 'step', 'finish' and 'held'"};
  }
  const bool has_parts = moves && behavior.progress->kind == ProgressWay::Kind::Grid;
  if (!has_parts && (behavior.step || drifts)) {
    return Problem{"has a step without a size",
                   "a step of 'step' and 'held' is a part of a grid: add progress=\"grid:10\""};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> check_behavior(const lockstep_leaf_type& leaf,
                                      std::span<const Parameter> ports) {
  if (leaf.behavior_count == 0) return std::nullopt;
  const auto told = [&](const Problem& wrong) {
    return Problem{fmt::format("('{}'): its behavior {}", leaf.id, wrong.message), wrong.hint};
  };
  if (leaf.behavior_count > kMaxDescriptorCount || leaf.behavior == nullptr) {
    return told({leaf.behavior == nullptr
                     ? fmt::format("has {} statements but no list of them", leaf.behavior_count)
                     : fmt::format("claims to have {} statements, expected at most {}",
                                   leaf.behavior_count, kMaxDescriptorCount),
                 "check lockstep_leaf_type::behavior_count"});
  }
  if (leaf.kind != LOCKSTEP_ACTION && leaf.kind != LOCKSTEP_CONDITION) {
    return told({"is that of a node with children", "only actions and conditions have one"});
  }
  Behavior behavior;
  std::set<std::string_view> words;
  for (const lockstep_behavior& it : std::span(leaf.behavior, leaf.behavior_count)) {
    if (it.word == nullptr || it.value == nullptr) {
      return told({"has a statement without a word or a value", "set both"});
    }
    if (!is_behavior_word(it.word)) {
      return told({fmt::format("has the unknown word '{}'", brief(it.word)),
                   suggested_behavior_word(it.word)});
    }
    if (!words.insert(it.word).second) {
      return told({fmt::format("has '{}' twice", brief(it.word)), "write it once"});
    }
    if (const auto wrong = add_statement(it.word, it.value, behavior)) {
      return told({fmt::format("has a wrong '{}': {}", it.word, wrong->message), wrong->hint});
    }
  }
  for (const Behavior::Named& output : behavior.outputs) {
    if (const auto wrong = check_output(output, ports)) return told(*wrong);
  }
  if (const auto wrong = check_against(leaf, behavior)) return told(*wrong);
  return std::nullopt;
}

}  // namespace lockstep::host
