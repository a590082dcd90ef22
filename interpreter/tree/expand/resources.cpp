#include "tree/expand/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/core/resource_set.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

class PoolResolver {
 public:
  PoolResolver(Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void resolve() {
    for (DefinitionGroup& group : definition_.groups) {
      if (definition_.is_pool(group)) resolve(group);
    }
    check_nesting();
    if (!report_.has_errors()) rank();
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  void resolve(DefinitionGroup& group) {
    const std::string_view declared = definition_.resources_of(at(group.node));
    for (const std::string_view name : resource_names(declared)) {
      group.resources.emplace_back(name);
    }
    for (const std::uint32_t member : group.members) {
      for (const std::string_view name : resource_names(definition_.resources_of(at(member)))) {
        if (std::ranges::find(group.resources, name) != group.resources.end()) continue;
        if (declared.empty()) {
          group.resources.emplace_back(name);
        } else {
          unknown(group, member, name);
        }
      }
    }
    const auto neighbors = std::ranges::adjacent_find(group.members, [this](auto one, auto other) {
      return is_around(one, other) || is_before(one, other);
    });
    group.has_relatives = neighbors != group.members.end();
    check_count(group);
  }

  bool is_around(std::uint32_t outer, std::uint32_t node) const {
    return outer < node && node < at(outer).end;
  }
  // They are in different children of a Sequence, in this order.
  bool is_before(std::uint32_t one, std::uint32_t other) const {
    const std::uint32_t pair[] = {one, other};
    return !is_around(one, other) &&
           at(definition_.common_ancestor(pair)).type->goes_on_after == Status::Success;
  }

  void unknown(const DefinitionGroup& group, std::uint32_t member, std::string_view name) {
    const DefinitionNode& node = at(member);
    if (!reported_.emplace(node.place.byte, name).second) return;
    if (report_.counted_only(Severity::Error)) return;
    const std::vector<std::string_view> known(group.resources.begin(), group.resources.end());
    const std::string message =
        fmt::format("the pool '{}' has no resource '{}'", brief(at(group.node).name), brief(name));
    const std::string hint = suggest(name, known, "its resources");
    for (const WrittenAttribute& attribute : definition_.attributes(node)) {
      if (attribute.name == "resources")
        return report_.at_value("unknown-resource"_code, attribute.place, message, hint);
    }
    report_.at("unknown-resource"_code, node.place, message, hint);
  }

  void check_count(const DefinitionGroup& group) const {
    const DefinitionNode& node = at(group.node);
    if (group.resources.empty()) {
      if (report_.has_errors()) return;  // it may come from these
      report_.at("pool-size"_code, node.place,
                 fmt::format("no resource of the pool '{}' is known", brief(node.name)),
                 "where only entries name them, declare them here: resources=\"left;right\"");
    } else if (group.resources.size() > kMaxResources) {
      report_.at(
          "pool-size"_code, node.place,
          fmt::format("the pool '{}' has {} resources", brief(node.name), group.resources.size()),
          fmt::format("the limit is {}: split it into several pools", kMaxResources));
    } else if (group.resources.size() > kMaxExchanged) {
      check_exchanges(group);
    }
  }

  bool exchanges(std::uint32_t member) const {
    const Value* on_change = definition_.constant(at(member), "on_change");
    return on_change != nullptr && *on_change == Value("exchange");
  }
  bool would_take_over(const DefinitionGroup& group, std::uint32_t member) const {
    return definition_.keeps(at(member)) &&
           std::ranges::any_of(group.members, [&](std::uint32_t other) {
             return other < member && is_before(other, member) && may_share(other, member);
           });
  }

  // With an entry that is not known.
  bool may_share(std::uint32_t one, std::uint32_t other) const {
    const Value* const its = definition_.constant(at(one), "resources");
    if (its == nullptr || definition_.constant(at(other), "resources") == nullptr) return true;
    const auto names = resource_names(definition_.resources_of(at(one)));
    return std::ranges::any_of(resource_names(definition_.resources_of(at(other))), [&](auto name) {
      return std::ranges::find(names, name) != names.end();
    });
  }

  void check_exchanges(const DefinitionGroup& group) const {
    const auto tell = [&](std::uint32_t member, std::string_view what, Severity severity) {
      report_.at("pool-size"_code, at(member).place,
                 fmt::format("the pool '{}' has {} resources, more than a member can {}",
                             brief(at(group.node).name), group.resources.size(), what),
                 fmt::format("the limit is {}: split it into several pools", kMaxExchanged),
                 severity);
    };
    for (const std::uint32_t member : group.members) {
      if (exchanges(member)) {
        tell(member, "exchange", Severity::Error);
      } else if (would_take_over(group, member)) {
        tell(member, "take over from the one before it", Severity::Warning);
      }
    }
  }

  // Where two pools are nested both ways, two members could wait for each other.
  void check_nesting() {
    for (const DefinitionGroup& group : definition_.groups) {
      if (!definition_.is_pool(group)) continue;
      for (const std::uint32_t member : group.members) pools_.emplace(member, group.node);
    }
    for (const DefinitionGroup& group : definition_.groups) {
      if (!definition_.is_pool(group)) continue;
      for (const std::uint32_t member : group.members) {
        for (std::uint32_t node = member; at(node).parent != node;) {
          node = at(node).parent;
          if (pools_.contains(node)) check_nested(group.node, member, node);
        }
      }
    }
  }

  void check_nested(std::uint32_t pool, std::uint32_t inner, std::uint32_t outer) {
    const std::uint32_t outer_pool = pools_.at(outer);
    if (outer_pool == pool) return;
    nested_.emplace(outer_pool, pool);
    if (!is_inside(outer_pool, pool)) return;
    add(inner,
        fmt::format("the pool '{}' is used inside of '{}' here, and the other way elsewhere",
                    brief(at(pool).name), brief(at(outer_pool).name)),
        "two nodes may deadlock: nest pools in one order, or make them one");
  }

  // Whether a pool is used inside of another one, also through third ones.
  bool is_inside(std::uint32_t inner, std::uint32_t outer) const {
    std::vector<std::uint32_t> open{outer};
    std::set<std::uint32_t> seen;
    while (!open.empty()) {
      const std::uint32_t pool = open.back();
      open.pop_back();
      if (pool == inner) return true;
      if (!seen.insert(pool).second) continue;
      for (const auto& [from, to] : nested_) {
        if (from == pool) open.push_back(to);
      }
    }
    return false;
  }

  // A barrier before the pools, whose members it may hold; a pool before those inside of it.
  void rank() {
    for (DefinitionGroup& group : definition_.groups) group.rank = definition_.is_pool(group);
    for (std::size_t i = 0; i < nested_.size(); ++i) {
      for (const auto& [outer, inner] : nested_) {
        group(inner).rank = std::max(group(inner).rank, group(outer).rank + 1);
      }
    }
  }

  DefinitionGroup& group(std::uint32_t node) {
    return definition_.groups[node - definition_.nodes[0].end];
  }

  void add(std::uint32_t node, std::string message, std::string hint) {
    if (!reported_.emplace(at(node).place.byte, std::string_view()).second) return;
    report_.at("nested-pools"_code, at(node).place, std::move(message), std::move(hint));
  }

  Definition& definition_;
  const Reporter& report_;
  std::map<std::uint32_t, std::uint32_t> pools_;                   // of each member: its pool
  std::set<std::pair<std::uint32_t, std::uint32_t>> nested_;       // pools: the outer, the inner
  std::set<std::pair<std::uint32_t, std::string_view>> reported_;  // where, and which name
};

}  // namespace

void resolve_resources(Definition& definition, const Reporter& report) {
  PoolResolver(definition, report).resolve();
}

}  // namespace lockstep::host
