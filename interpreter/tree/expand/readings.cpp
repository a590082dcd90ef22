#include "tree/expand/readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/property/node_names.h"
#include "tree/paths.h"

namespace lockstep::host {
namespace {

class ReadingResolver {
 public:
  ReadingResolver(Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void resolve() {
    for (BoundScript& script : definition_.scripts) {
      if (script.code == nullptr) continue;
      for (std::size_t i = 0; i < script.code->readings().size(); ++i) {
        const Reading& it = script.code->readings()[i];
        const auto found = find(script.inside, it, script.renamed.empty() ? "" : script.renamed[i]);
        if (!found) {
          tell(script, it, found.error());
          continue;
        }
        found_.push_back(*found);
        script.readings.push_back(static_cast<std::uint32_t>(found_.size() - 1));
      }
    }
    number();
  }

 private:
  // In the order of the nodes, each once: so they are read before each tick.
  void number() {
    auto& all = definition_.readings;
    all = found_;
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (BoundScript& script : definition_.scripts) {
      for (std::uint32_t& it : script.readings) {
        it = static_cast<std::uint32_t>(std::ranges::lower_bound(all, found_[it]) - all.begin());
      }
    }
  }

  Result<BoundReading> find(std::uint32_t inside, const Reading& reading,
                            std::string_view renamed) {
    if (!renamed.empty()) {
      if (const auto found = find_renamed(inside, reading, renamed)) return *found;
    }
    if (reading.what == Reading::What::Owner) return find_resource(inside, reading.of);
    const auto key = std::tuple(inside, std::string_view(reading.of));
    auto known = nodes_.find(key);
    if (known == nodes_.end()) known = nodes_.emplace(key, find_node_in(inside, reading.of)).first;
    if (!known->second) return tl::unexpected(known->second.error());
    return BoundReading{.node = *known->second, .what = reading.what};
  }

  // Where a SubTree gives a barrier or a pool another name, nodes of the same SubTree come first.
  std::optional<BoundReading> find_renamed(std::uint32_t inside, const Reading& reading,
                                           std::string_view name) {
    const auto group = std::ranges::find(definition_.groups, name, [this](const auto& it) {
      return definition_.nodes[it.node].name;
    });
    if (group == definition_.groups.end()) return std::nullopt;
    if (reading.what != Reading::What::Owner) {
      if (find_inside(inside, reading.of)) return std::nullopt;
      return BoundReading{.node = group->node, .what = reading.what};
    }
    const auto resource = std::ranges::find(
        group->resources, std::string_view(reading.of).substr(group_in(reading).size() + 1));
    if (resource == group->resources.end()) return std::nullopt;
    return BoundReading{
        .node = group->node,
        .what = reading.what,
        .resource = static_cast<std::uint32_t>(resource - group->resources.begin())};
  }

  std::optional<std::uint32_t> find_inside(std::uint32_t tree, std::string_view name) {
    if (!ends_) {
      paths_ = paths_of(definition_);
      ends_.emplace(paths_);
    }
    const auto all = static_cast<std::uint32_t>(paths_.size());
    return ends_->find(name, paths_, tree, tree == 0 ? all : definition_.nodes[tree].end);
  }

  Result<std::uint32_t> find_node_in(std::uint32_t inside, std::string_view name) {
    while (inside != 0) {
      if (const auto found = find_inside(inside, name)) return *found;
      for (const auto& [written, group] : groups_in(inside)) {
        if (written == name) return group->node;
      }
      inside = around(inside);
    }
    for (const auto& [written, group] : groups_in(0)) {  // the main tree may be a SubTree itself
      if (written == name) return group->node;
    }
    if (const auto found = find_inside(0, name)) return *found;
    return find_node(name, paths_);  // says why not
  }

  using NamedGroups = std::vector<std::pair<std::string_view, const DefinitionGroup*>>;

  // The SubTree around a node; 0: none.
  std::uint32_t around(std::uint32_t node) const {
    while (node != 0) {
      node = definition_.nodes[node].parent;
      if (definition_.nodes[node].type->category == NodeCategory::SubTree) break;
    }
    return node;
  }

  // The barriers and pools that the nodes of a SubTree use, as they name them: an include as north,
  // or an attribute of the SubTree, gives them others.
  NamedGroups groups_in(std::uint32_t tree) const {
    NamedGroups groups;
    for (const DefinitionGroup& group : definition_.groups) {
      for (const std::uint32_t member : group.members) {
        if (around(member) == tree) groups.emplace_back(written_group(member), &group);
      }
    }
    std::ranges::sort(groups);
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    return groups;
  }

  std::string_view written_group(std::uint32_t member) const {
    const DefinitionNode& node = definition_.nodes[member];
    const auto of_group = std::ranges::find_if(node.type->parameters,
                                               [](const auto& it) { return !it.group.empty(); });
    for (std::uint32_t i = node.written; i < definition_.written.size(); ++i) {
      const WrittenAttribute& it = definition_.written[i];
      if (it.name == of_group->name) return it.value;
      if (it.is_last) break;
    }
    return {};
  }

  // "dock", or "yard/dock" where several pools have one. First of the pools that the tree of the
  // script uses, then of those that the trees around it use, then of all.
  Result<BoundReading> find_resource(std::uint32_t inside, std::string_view name) const {
    for (bool is_main = false; !is_main; inside = around(inside)) {
      const NamedGroups groups = groups_in(inside);
      if (!resources_of(groups, name).empty()) return the_one(groups, name);
      is_main = inside == 0;  // also where the main tree is nothing but a SubTree
    }
    NamedGroups all;
    for (const DefinitionGroup& group : definition_.groups) {
      all.emplace_back(definition_.nodes[group.node].name, &group);
    }
    return the_one(all, name);
  }

  struct NamedResource {
    std::string path;
    BoundReading owner;
  };

  std::vector<NamedResource> resources_of(const NamedGroups& groups, std::string_view name) const {
    std::vector<NamedResource> found;
    for (const auto& [pool, group] : groups) {
      for (std::uint32_t i = 0; i < group->resources.size(); ++i) {
        std::string path = fmt::format("{}/{}", pool, group->resources[i]);
        if (group->resources[i] != name && path != name) continue;
        found.push_back(
            {std::move(path), {.node = group->node, .what = Reading::What::Owner, .resource = i}});
      }
    }
    return found;
  }

  Result<BoundReading> the_one(const NamedGroups& groups, std::string_view name) const {
    const std::vector<NamedResource> found = resources_of(groups, name);
    if (found.size() == 1) return found.front().owner;
    if (!found.empty()) {
      std::vector<std::string> paths;
      for (const NamedResource& it : found) paths.push_back(it.path);
      return problem(fmt::format("'{}' is a resource of {} pools", brief(name), found.size()),
                     fmt::format("write which one is meant: {}", joined(paths, " or ")));
    }
    std::vector<std::string_view> names;
    for (const auto& [pool, group] : groups) {
      names.insert(names.end(), group->resources.begin(), group->resources.end());
    }
    if (names.empty()) {
      return problem(fmt::format("no resource '{}': no node of the tree uses a pool", brief(name)),
                     "<resources> in 'root' declares a pool, and UseResources uses it");
    }
    return problem(fmt::format("no resource '{}'", brief(name)),
                   suggest(name, names, "the resources are"));
  }

  // Once, however often a SubTree is used.
  void tell(const BoundScript& script, const Reading& reading, const Problem& wrong) {
    if (!told_.emplace(script.place.byte, reading.offset).second) return;
    report_.in_value("bad-reading"_code, script.place, reading.offset,
                     fmt::format("{}: {}", shown(reading), wrong.message), wrong.hint);
  }

  Definition& definition_;
  const Reporter& report_;
  std::vector<BoundReading> found_;
  std::vector<std::string> paths_;
  std::optional<PathEnds> ends_;
  std::map<std::tuple<std::uint32_t, std::string_view>, Result<std::uint32_t>> nodes_;
  std::set<std::pair<std::size_t, std::size_t>> told_;
};

}  // namespace

std::string_view group_in(const Reading& reading) {
  const std::string_view name = reading.of;
  if (reading.what != Reading::What::Owner) return name;
  const auto slash = name.rfind('/');
  return slash == name.npos ? std::string_view() : name.substr(0, slash);
}

void resolve_readings(Definition& definition, const Reporter& report) {
  ReadingResolver(definition, report).resolve();
}

}  // namespace lockstep::host
