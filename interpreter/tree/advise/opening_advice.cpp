#include <fmt/format.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/core/wording.h"
#include "tree/advise/group_advice.h"

namespace lockstep::host {
namespace {

// Where idle members are not waited for, the others pass while one that has failed waits to begin
// again. For example, in Retry(Sequence(Wait, SyncProgress)) it is idle during each Wait.
class OpeningAdviser {
 public:
  OpeningAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() const {
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.waits(group) || definition_.is_pool(group)) continue;
      advise_beginning(group);
      advise(group);
    }
  }

 private:
  static constexpr int kMostTold = 10;  // of a barrier
  static constexpr std::uint32_t kNone = 0xffffffff;

  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  void advise_beginning(const DefinitionGroup& barrier) const {
    const DefinitionNode& node = at(barrier.node);
    const Value* value = definition_.constant(node, "barriers");
    const auto* list = value == nullptr ? nullptr : std::get_if<std::vector<double>>(value);
    if (list == nullptr || list->empty() || list->front() != 0) return;
    report_.at("begins-apart"_code, node.place,
               fmt::format("the members of '{}' do not begin together", brief(node.name)),
               "its barrier at 0 does not wait for idle members: leave out idle=\"ignore\"",
               Severity::Warning);
  }

  // A Retry or Repeat begins a member again after its failure, and a node that takes its time comes
  // first. The member is idle then.
  void advise(const DefinitionGroup& barrier) const {
    const std::uint32_t ancestor = definition_.common_ancestor(barrier.members);
    int told = 0;
    for (const std::uint32_t member : barrier.members) {
      std::uint32_t waits = kNone;
      for (std::uint32_t node = member; node != ancestor && told < kMostTold;
           node = at(node).parent) {
        if (waits != kNone && begins_again(node)) {
          add(barrier, member, waits, node);
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

  void add(const DefinitionGroup& barrier, std::uint32_t member, std::uint32_t waits,
           std::uint32_t loop) const {
    if (report_.counted_only(Severity::Note)) return;
    const std::string name = brief(at(member).name);
    report_.at("opens-early"_code, at(member).place,
               fmt::format("after a failure of '{}', '{}' does not wait for it while '{}' runs",
                           name, brief(at(barrier.node).name), brief(at(waits).name)),
               fmt::format("'{}' makes it idle, which idle=\"ignore\" leaves out; with "
                           "idle=\"wait\" the barrier stays closed",
                           brief(at(loop).name)),
               Severity::Note);
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void note_openings(const Definition& definition, const Reporter& report) {
  OpeningAdviser(definition, report).advise();
}

}  // namespace lockstep::host
