#include "groot/subtrees.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "groot/statuses.h"

namespace lockstep::host {
namespace {

// As the library calls it: by its name, or by its tree and uid.
std::string path_of(const GrootSubtree& outer, std::string_view id, std::string_view name,
                    std::uint32_t node, std::set<std::string>& known) {
  const std::string before = outer.path.empty() ? "" : outer.path + "/";
  std::string path = before + std::string(name);
  if (name == id || !known.insert(path).second) {
    path = fmt::format("{}{}::{}", before, id, groot_uid(node));
    known.insert(path);
  }
  return path;
}

}  // namespace

std::vector<GrootSubtree> groot_subtrees(const Definition& definition) {
  std::vector<GrootSubtree> subtrees{{.id = definition.id, .path = {}}};
  std::set<std::string> known;
  std::vector<std::uint32_t> open{0};  // the subtrees that the node is in, in this list
  const auto& nodes = definition.nodes;
  for (std::uint32_t node = 0; node < nodes[0].end; ++node) {
    while (open.size() > 1 && nodes[subtrees[open.back()].node].end <= node) open.pop_back();
    if (nodes[node].type->category != NodeCategory::SubTree) continue;
    const std::string_view id = written_value(definition, nodes[node], "ID");
    GrootSubtree inner{.id = id, .path = {}, .node = node, .root = node + 1, .outer = open.back()};
    inner.path = path_of(subtrees[inner.outer], id, nodes[node].name, node, known);
    open.push_back(static_cast<std::uint32_t>(subtrees.size()));
    subtrees.push_back(std::move(inner));
  }
  return subtrees;
}

std::string_view written_value(const Definition& definition, const DefinitionNode& node,
                               std::string_view attribute) {
  const auto written = definition.attributes(node);
  const auto found = std::ranges::find(written, attribute, &WrittenAttribute::name);
  return found == written.end() ? std::string_view() : found->value;
}

}  // namespace lockstep::host
