#include "tree/expand/readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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
      for (const Reading& it : script.code->readings()) {
        const auto found = find(script.inside, it);
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

  Result<BoundReading> find(std::uint32_t inside, const Reading& reading) {
    if (reading.what == Reading::What::Owner) return find_resource(reading.of);
    const auto key = std::tuple(inside, std::string_view(reading.of));
    auto known = nodes_.find(key);
    if (known == nodes_.end()) known = nodes_.emplace(key, find_node_in(inside, reading.of)).first;
    if (!known->second) return tl::unexpected(known->second.error());
    return BoundReading{.node = *known->second, .what = reading.what};
  }

  Result<std::uint32_t> find_node_in(std::uint32_t inside, std::string_view name) {
    if (paths_.empty()) paths_ = paths_of(definition_);
    while (inside != 0) {
      const std::size_t end = definition_.nodes[inside].end;
      const auto paths = std::span(paths_).subspan(inside, end - inside);
      if (const auto found = find_node(name, paths)) return inside + *found;
      do {
        inside = definition_.nodes[inside].parent;
      } while (inside != 0 && definition_.nodes[inside].type->category != NodeCategory::SubTree);
    }
    return find_node(name, paths_);
  }

  // "dock", or "yard/dock" where several pools have one.
  Result<BoundReading> find_resource(std::string_view name) const {
    std::vector<BoundReading> found;
    std::vector<std::string> full;
    std::vector<std::string_view> names;
    for (const DefinitionGroup& group : definition_.groups) {
      if (!definition_.is_pool(group)) continue;
      const std::string_view pool = definition_.nodes[group.node].name;
      for (std::uint32_t i = 0; i < group.resources.size(); ++i) {
        const std::string path = fmt::format("{}/{}", pool, group.resources[i]);
        names.push_back(group.resources[i]);
        if (group.resources[i] != name && path != name) continue;
        found.push_back({.node = group.node, .what = Reading::What::Owner, .resource = i});
        full.push_back(path);
      }
    }
    if (found.size() == 1) return found.front();
    if (!found.empty()) {
      return problem(fmt::format("'{}' is a resource of {} pools", brief(name), found.size()),
                     fmt::format("write which one is meant: {}", joined(full, " or ")));
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
  std::map<std::tuple<std::uint32_t, std::string_view>, Result<std::uint32_t>> nodes_;
  std::set<std::pair<std::size_t, std::size_t>> told_;
};

}  // namespace

void resolve_readings(Definition& definition, const Reporter& report) {
  ReadingResolver(definition, report).resolve();
}

}  // namespace lockstep::host
