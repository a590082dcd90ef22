#include <fmt/format.h>

#include <string>
#include <string_view>

#include "base/core/wording.h"
#include "tree/advise/group_advice.h"

namespace lockstep::host {
namespace {

// Where idle members are waited for, the others wait for ever for one that a node never runs. Where
// they are not, the others pass while one that has failed waits to begin again.
class IdleMemberAdviser {
 public:
  IdleMemberAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() const {
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.waits(group)) {
        advise(group);
      } else if (!definition_.is_pool(group)) {
        note_openings(group);
      }
    }
  }

 private:
  static constexpr int kMostTold = 10;  // of a barrier
  static constexpr std::uint32_t kNone = 0xffffffff;

  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  // Only nodes below the common ancestor are named: those around it keep all members from running.
  void advise(const DefinitionGroup& barrier) const {
    const std::uint32_t ancestor = definition_.common_ancestor(barrier.members);
    const bool repeats = may_repeat(ancestor);
    int told = 0;
    for (const std::uint32_t member : barrier.members) {
      for (std::uint32_t node = member; node != ancestor; node = at(node).parent) {
        const Reason reason = why_not(node, repeats);
        if (reason.text.empty()) continue;
        add(barrier, member, reason);
        if (++told == kMostTold) return;
        break;
      }
    }
  }

  struct Reason {
    std::uint32_t node = 0;
    std::string_view text = {};
  };

  // Why that node may not be ticked, though the common ancestor is. One that is skipped is waited
  // for by nobody.
  Reason why_not(std::uint32_t node, bool repeats) const {
    if (may_end_at_once(node)) return {node, "a script may end it without a tick"};
    const std::uint32_t around = at(node).parent;
    if (at(around).type->goes_on_after == Status::Failure && node != around + 1) {
      return {around, "a Fallback ticks a later child only after the earlier ones have failed"};
    }
    if (is_branch(node)) return {around, "a branch runs only if it is chosen"};
    const NodeType& type = *at(node).type;
    const bool is_decorator = type.category == NodeCategory::Decorator;
    if (repeats && is_decorator && type.again == Again::ReturnsResult) {
      return {node, "when what is around begins again, it may return the last result instead"};
    }
    return {};
  }

  bool may_end_at_once(std::uint32_t node) const {
    if (at(node).hooks >= definition_.hooks.size()) return false;
    const NodeHooks& hooks = definition_.hooks[at(node).hooks];
    return hooks[static_cast<std::size_t>(Hook::FailureIf)] != Port::kNone ||
           hooks[static_cast<std::size_t>(Hook::SuccessIf)] != Port::kNone;
  }

  // True if the control node around it chooses among its children. The first one is a condition,
  // except in a Switch, which has cases.
  bool is_branch(std::uint32_t node) const {
    const DefinitionNode& around = at(at(node).parent);
    if (around.type->category != NodeCategory::Control) return false;
    if (around.type->goes_on_after != Status::Idle || around.type->latches) return false;
    return node != at(node).parent + 1 || definition_.has(around, "cases");
  }

  // Whether that node may begin again in the run: something around it ticks it after its success.
  bool may_repeat(std::uint32_t node) const {
    while (node != at(node).parent) {
      node = at(node).parent;
      const NodeType& type = *at(node).type;
      const bool is_decorator = type.category == NodeCategory::Decorator;
      if (is_decorator && (type.can_run || type.again != Again::Acts)) return true;
      if (definition_.forgets(at(node))) return true;
    }
    return false;
  }

  // A Retry or Repeat begins a member again after its failure, and a node that takes its time comes
  // first. The member is idle then.
  void note_openings(const DefinitionGroup& barrier) const {
    const std::uint32_t ancestor = definition_.common_ancestor(barrier.members);
    int told = 0;
    for (const std::uint32_t member : barrier.members) {
      std::uint32_t waits = kNone;
      for (std::uint32_t node = member; node != ancestor && told < kMostTold;
           node = at(node).parent) {
        if (waits != kNone && begins_again(node)) {
          add_opening(barrier, member, waits, node);
          ++told;
          break;
        }
        if (waits == kNone) waits = timed_before(node);
      }
    }
  }

  // A decorator with a count of attempts or rounds.
  bool begins_again(std::uint32_t node) const {
    const NodeType& type = *at(node).type;
    return type.repeats_after != Status::Idle && !type.parameters.empty();
  }

  // A node that waits before each tick of that one, or kNone.
  std::uint32_t timed_before(std::uint32_t node) const {
    const std::uint32_t around = at(node).parent;
    const NodeType& type = *at(around).type;
    if (type.category == NodeCategory::Decorator) return is_timed(around) ? around : kNone;
    if (type.goes_on_after == Status::Idle) return kNone;
    for (std::uint32_t before = around + 1; before < node; ++before) {
      if (is_timed(before)) return before;
    }
    return kNone;
  }
  bool is_timed(std::uint32_t node) const {
    return at(node).type->can_run && definition_.has(at(node), "seconds");
  }

  void add_opening(const DefinitionGroup& barrier, std::uint32_t member, std::uint32_t waits,
                   std::uint32_t loop) const {
    if (report_.counted_only(Severity::Note)) return;
    const std::string name = brief(at(member).name);
    report_.at(at(member).place,
               fmt::format("after a failure of '{}', '{}' does not wait for it while '{}' runs",
                           name, brief(at(barrier.node).name), brief(at(waits).name)),
               fmt::format("'{}' makes it idle, which idle=\"ignore\" leaves out; with "
                           "idle=\"wait\" the barrier stays closed",
                           brief(at(loop).name)),
               Severity::Note);
  }

  void add(const DefinitionGroup& barrier, std::uint32_t member, const Reason& reason) const {
    if (report_.counted_only(Severity::Note)) return;
    report_.at(at(member).place,
               fmt::format("the others at '{}' wait for '{}' for ever if '{}' does not run it",
                           brief(at(barrier.node).name), brief(at(member).name),
                           brief(at(reason.node).name)),
               fmt::format("{}; idle=\"ignore\" waits only for members that run", reason.text),
               Severity::Note);
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void note_idle_members(const Definition& definition, const Reporter& report) {
  IdleMemberAdviser(definition, report).advise();
}

}  // namespace lockstep::host
