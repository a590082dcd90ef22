// Notes two actions of one device under a reactive parent: it ticks the one that comes first, and
// then halts the one that ran, in one tick.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "tree/advise/group_advice.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostVisited = 10'000'000;  // nodes, each once for each reactive parent

class HandoverAdviser {
 public:
  HandoverAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() {
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.is_pool(group)) members_.insert(group.members.begin(), group.members.end());
    }
    std::uint64_t visited = 0;
    for (std::uint32_t node = 0; node < definition_.nodes.size(); ++node) {
      if (at(node).children < 2 || !is_reactive(node)) continue;
      visited += at(node).end - node;
      if (visited > kMostVisited) return;
      look_below(node);
    }
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  bool is_reactive(std::uint32_t node) const {
    const NodeType& type = *at(node).type;
    return type.is_reactive ||
           (definition_.forgets(at(node)) && type.goes_on_after != Status::Idle);
  }

  // A port as it is written: of actions of this type.
  using Use = std::tuple<const NodeType*, std::string_view, std::string_view>;
  struct First {
    std::uint32_t child, action;
  };

  // One note is enough for a parent.
  void look_below(std::uint32_t parent) {
    std::map<Use, First> uses;
    for (const std::uint32_t child : children_in(definition_.nodes, parent)) {
      for (std::uint32_t node = child; node < at(child).end; ++node) {
        const NodeType& type = *at(node).type;
        const bool is_builtin = type.plugin.empty() && type.mock == nullptr;
        if (members_.contains(node)) {  // it has to wait for its turn
          node = at(node).end - 1;
        } else if (type.category == NodeCategory::Action && type.can_run && !is_builtin) {
          for (const WrittenAttribute& it : definition_.attributes(at(node))) {
            if (!is_input(type, it.name)) continue;
            const First first{child, node};
            const auto [known, is_new] = uses.emplace(Use{&type, it.name, it.value}, first);
            if (!is_new && known->second.child != child && is_decided(known->second)) {
              return note(parent, known->second.action, node, it);
            }
          }
        }
      }
    }
  }

  // Else it is started again in every tick, which is another warning.
  bool is_decided(const First& it) const {
    return it.child != it.action || at(it.action).hooks != Port::kNone;
  }

  static bool is_input(const NodeType& type, std::string_view name) {
    const auto port = std::ranges::find(type.parameters, name, &Parameter::name);
    return port != type.parameters.end() && port->direction != Direction::Output;
  }

  // Once, however often a SubTree is used.
  void note(std::uint32_t parent, std::uint32_t first, std::uint32_t second,
            const WrittenAttribute& port) {
    if (!told_.insert(at(parent).place.byte).second) return;
    if (report_.counted_only(Severity::Note)) return;
    report_.at("overlap"_code, at(first).place,
               fmt::format("'{}' begins before '{}' is halted, in one tick: both are {} with "
                           "{}=\"{}\"",
                           brief(at(first).name), brief(at(second).name), brief(at(first).type->id),
                           brief(port.name), brief(port.value)),
               fmt::format("'{}' ticks the child that comes first, and then halts the one that "
                           "ran; where they must not overlap, give both the same resource of a "
                           "pool",
                           brief(at(parent).name)),
               Severity::Note);
  }

  const Definition& definition_;
  const Reporter& report_;
  std::set<std::uint32_t> members_;  // of pools
  std::set<std::uint32_t> told_;
};

}  // namespace

void note_handovers(const Definition& definition, const Reporter& report) {
  HandoverAdviser(definition, report).advise();
}

}  // namespace lockstep::host
