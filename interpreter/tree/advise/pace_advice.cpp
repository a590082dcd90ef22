// Of nodes with pace="true": who cannot be slowed, and what goes on at full speed beside them.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/core/pre_order.h"
#include "tree/advise/advise.h"
#include "tree/pace.h"

namespace lockstep::host {
namespace {

class PaceAdviser {
 public:
  PaceAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() const {
    for (std::uint32_t node = 0; node < definition_.nodes.size(); ++node) {
      if (paces(definition_, definition_.nodes[node])) look_at(node);
    }
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  std::vector<std::uint32_t> held_by(std::uint32_t node) const {
    std::vector<std::uint32_t> held;
    for (const DefinitionGroup& group : definition_.groups) {
      if (group.node != node) continue;
      for (const std::uint32_t member : group.members) held.push_back(member + 1);
    }
    if (at(node).children == 0) return held;
    for (const std::uint32_t child : children_in(definition_.nodes, node)) held.push_back(child);
    return held;
  }

  template <class Is>
  bool any_below(std::uint32_t node, Is is) const {
    for (std::uint32_t below = node; below < at(node).end; ++below) {
      if (is(at(below))) return true;
    }
    return false;
  }

  // A stand-in may be slowed on the robot.
  static bool can_be_slowed(const DefinitionNode& it) {
    return it.type->can_be_slowed || it.type->mock != nullptr;
  }
  static bool is_action(const DefinitionNode& it) {
    return it.type->category == NodeCategory::Action;
  }

  void look_at(std::uint32_t node) const {
    std::vector<std::uint32_t> actions, fixed;
    for (const std::uint32_t child : held_by(node)) {
      if (!any_below(child, is_action)) continue;
      actions.push_back(child);
      if (!any_below(child, can_be_slowed)) fixed.push_back(child);
    }
    if (fixed.size() == actions.size()) {
      report_.at(
          "no-pace"_code, at(node).place,
          fmt::format("'{}' has pace=\"true\", but no leaf below it can be slowed", at(node).name),
          "its children are held as without pace. A leaf that can be slowed has set_pace",
          Severity::Warning);
      return;
    }
    for (const std::uint32_t child : fixed) {
      report_.at("not-slowed"_code, at(child).place,
                 fmt::format("'{}' is not slowed by '{}', only held: none of its leaves can be "
                             "slowed",
                             at(child).name, at(node).name),
                 way_to_slow(child), Severity::Note);
    }
    for (const std::uint32_t child : actions) {
      if (std::ranges::find(fixed, child) == fixed.end()) look_for_unslowed(node, child);
      look_for_times(node, child);
    }
    look_at_count(node, actions.size());
  }

  static bool has(const DefinitionNode& it, std::string_view parameter) {
    return std::ranges::find(it.type->parameters, parameter, &Parameter::name) !=
           it.type->parameters.end();
  }
  // It could be slowed, if the tree said how.
  static bool lacks_pace(const DefinitionNode& it) {
    return is_action(it) && has(it, "pace") && !can_be_slowed(it);
  }
  std::string way_to_slow(std::uint32_t node) const {
    for (std::uint32_t below = node; below < at(node).end; ++below) {
      if (!lacks_pace(at(below))) continue;
      return fmt::format("give '{}' pace; `lockstep nodes {}` has the ways", at(below).name,
                         at(below).type->id);
    }
    return {};
  }

  void look_for_unslowed(std::uint32_t node, std::uint32_t child) const {
    for (std::uint32_t below = child; below < at(child).end; ++below) {
      if (!lacks_pace(at(below))) continue;
      report_.at(
          "not-slowed"_code, at(below).place,
          fmt::format("'{}' is not slowed by '{}', only held", at(below).name, at(node).name),
          way_to_slow(below), Severity::Note);
    }
  }

  // A time that goes on while its child is slow ends sooner, in the child's own time.
  void look_for_times(std::uint32_t node, std::uint32_t child) const {
    for (std::uint32_t below = child; below < at(child).end; ++below) {
      const DefinitionNode& it = at(below);
      look_for_allowance(node, it);
      if (!it.type->limits_time || stands_with_child(it)) continue;
      report_.at("unslowed-time"_code, it.place,
                 fmt::format("the time of '{}' is not slowed when '{}' slows what is in it",
                             it.name, at(node).name),
                 has_clock(it)
                     ? "it may end too early; clock=\"active\" counts as slowly as its child"
                     : "it may end too early: give it a longer time",
                 Severity::Warning);
    }
  }
  // Of a goal: the server counts it.
  void look_for_allowance(std::uint32_t node, const DefinitionNode& leaf) const {
    for (std::size_t i = 0; i < leaf.type->parameters.size(); ++i) {
      const std::string_view name = leaf.type->parameters[i].name;
      const Port& port = definition_.ports[leaf.first + i];
      const bool is_given = port.entry != Port::kNone || port.value != Port::kNone;
      if (!is_given || (name != "time_allowance" && !name.ends_with(".time_allowance"))) continue;
      report_.at("unslowed-time"_code, leaf.place,
                 fmt::format("'{}' of '{}' counts in full while '{}' slows or holds it", name,
                             leaf.name, at(node).name),
                 "its server may end it too early: give it a longer time", Severity::Note);
    }
  }
  static bool has_clock(const DefinitionNode& it) { return has(it, "clock"); }
  bool stands_with_child(const DefinitionNode& it) const {
    if (!has_clock(it)) return false;
    const Value* clock = definition_.constant(it, "clock");
    return clock != nullptr && *clock == Value("active");
  }

  void look_at_count(std::uint32_t node, std::size_t actions) const {
    const auto place =
        std::ranges::find(at(node).type->parameters, "success_count", &Parameter::name);
    if (place == at(node).type->parameters.end()) return;
    const Value* count = definition_.constant(at(node), "success_count");
    const auto* number = count == nullptr ? nullptr : std::get_if<std::int64_t>(count);
    if (number == nullptr || *number >= static_cast<std::int64_t>(actions)) return;
    const bool is_delta = definition_.synchronization(at(node)) == Synchronization::Relative;
    report_.at(
        "pace-without-all"_code, at(node).place,
        fmt::format("'{}' succeeds with {} of {} children, so it slows none{}", at(node).name,
                    *number, actions, is_delta ? "" : " on the way to a barrier at 1"),
        {}, Severity::Note);
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void advise_paces(const Definition& definition, const Reporter& report) {
  PaceAdviser(definition, report).advise();
}

}  // namespace lockstep::host
