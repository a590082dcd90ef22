#include <fmt/format.h>

#include <algorithm>

#include "base/core/resource_set.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "tree/expand/resources.h"

namespace lockstep::host {
namespace {

class ResourceAdviser {
 public:
  ResourceAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() const {
    for (const DefinitionGroup& group : definition_.groups) {
      if (!definition_.is_pool(group) || group.members.size() == 1) continue;
      const DefinitionNode& pool = at(group.node);
      if (number(pool, "increment") == 0) starvation(pool);
      if (!definition_.has(pool, "resources")) misspelled(group);
    }
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  std::int64_t number(const DefinitionNode& node, std::string_view parameter) const {
    const Value* value = definition_.constant(node, parameter);
    return value == nullptr ? 0 : std::get<std::int64_t>(*value);
  }

  void starvation(const DefinitionNode& pool) const {
    report_.at("starvation"_code, pool.place,
               fmt::format("the members of '{}' may wait indefinitely", brief(pool.name)),
               "with increment=\"0\" the first in the tree always wins; without it, no member "
               "waits for long",
               Severity::Warning);
  }

  // A name that one member alone uses, and that is nearly the name of another resource.
  void misspelled(const DefinitionGroup& group) const {
    const std::vector<std::uint32_t> users = count_users(group);
    std::vector<std::string_view> shared;
    for (std::size_t i = 0; i < users.size(); ++i) {
      if (users[i] > 1) shared.push_back(group.resources[i]);
    }
    for (std::size_t i = 0; i < users.size(); ++i) {
      if (users[i] != 1) continue;
      const std::string hint = did_you_mean(group.resources[i], shared);
      if (!hint.empty()) report_misspelled(group, i, hint);
    }
  }

  ResourceSet named_by(std::uint32_t member, const DefinitionGroup& group) const {
    const std::string_view list = definition_.resources_of(at(member));
    return all_resources(resource_list(list, group.resources).request());
  }

  std::vector<std::uint32_t> count_users(const DefinitionGroup& group) const {
    std::vector<std::uint32_t> users(group.resources.size());
    for (const std::uint32_t member : group.members) {
      const ResourceSet set = named_by(member, group);
      for (std::size_t i = 0; i < users.size(); ++i)
        users[i] += static_cast<std::uint32_t>(set >> i & 1u);
    }
    return users;
  }

  void report_misspelled(const DefinitionGroup& group, std::size_t resource,
                         const std::string& hint) const {
    for (const std::uint32_t member : group.members) {
      const ResourceSet set = named_by(member, group);
      if ((set >> resource & 1u) == 0) continue;
      const std::string message =
          fmt::format("only this node uses the resource '{}' of '{}'",
                      brief(group.resources[resource]), brief(at(group.node).name));
      report_.at("lone-resource"_code, at(member).place, message, hint, Severity::Warning);
    }
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void advise_resources(const Definition& definition, const Reporter& report) {
  ResourceAdviser(definition, report).advise();
}

}  // namespace lockstep::host
