#include "tree/paths.h"

#include <array>
#include <list>
#include <memory_resource>
#include <unordered_map>

#include "base/core/pre_order.h"

namespace lockstep::host {
namespace {

void number_children(const Definition& definition, std::uint32_t parent,
                     std::vector<std::uint32_t>& numbers) {
  const auto& nodes = definition.nodes;
  bool numbered = false;  // else nobody is called "arm#2" from the start
  for (const std::uint32_t child : children_in(nodes, parent)) {
    numbered |= nodes[child].name.find('#') != std::string_view::npos;
  }
  std::array<std::byte, 2048> enough_for_few;
  std::pmr::monotonic_buffer_resource memory(enough_for_few.data(), enough_for_few.size());
  std::pmr::unordered_map<std::string_view, std::uint32_t> taken(&memory);  // and the last number
  taken.reserve(nodes[parent].children);
  std::list<std::string> segments;
  for (const std::uint32_t child : children_in(nodes, parent)) {
    const std::string_view name = nodes[child].name;
    const auto [entry, is_new] = taken.try_emplace(name, 1);
    if (is_new) continue;
    std::uint32_t& number = entry->second;
    const auto segment = [&] { return std::string(name) + "#" + std::to_string(number); };
    do {
      ++number;
    } while (numbered && !taken.try_emplace(segments.emplace_back(segment()), 1).second);
    numbers[child] = number;
  }
}

}  // namespace

std::vector<std::uint32_t> sibling_numbers(const Definition& definition) {
  const auto& nodes = definition.nodes;
  std::vector<std::uint32_t> numbers(nodes.size());
  for (const DefinitionGroup& group : definition.groups) {  // beside the root
    if (nodes[group.node].name == nodes[0].name) numbers[group.node] = 2;
  }
  for (std::uint32_t node = 0; node < nodes[0].end; ++node) {
    if (nodes[node].children > 1) number_children(definition, node, numbers);
  }
  return numbers;
}

std::vector<std::string> paths_of(const Definition& definition) {
  const std::vector<std::uint32_t> numbers = sibling_numbers(definition);
  std::vector<std::string> paths(definition.nodes.size());
  for (std::uint32_t node = 0; node < paths.size(); ++node) {
    const DefinitionNode& it = definition.nodes[node];
    const std::string_view above =
        it.parent == node ? definition.id : std::string_view(paths[it.parent]);
    paths[node].reserve(above.size() + 1 + it.name.size());
    paths[node].append(above).append("/").append(it.name);
    if (numbers[node] != 0) paths[node].append("#").append(std::to_string(numbers[node]));
  }
  return paths;
}

}  // namespace lockstep::host
