#include "base/core/resource_set.h"

#include <algorithm>

namespace lockstep::host {
namespace {

constexpr std::string_view kBetweenNames = ";, \t\r\n";

}  // namespace

std::string_view take_resource(std::string_view& list) {
  list.remove_prefix(std::min(list.find_first_not_of(kBetweenNames), list.size()));
  const std::string_view name = list.substr(0, list.find_first_of(kBetweenNames));
  list.remove_prefix(name.size());
  return name;
}

std::vector<std::string_view> resource_names(std::string_view list) {
  std::vector<std::string_view> names;
  for (auto name = take_resource(list); !name.empty(); name = take_resource(list))
    names.push_back(name);
  return names;
}

ResourceList resource_list(std::string_view list, std::span<const std::string> names) {
  ResourceList result;
  for (auto name = take_resource(list); !name.empty(); name = take_resource(list)) {
    const auto it = std::ranges::find(names, name);
    if (it == names.end()) return {.unknown = name};
    result.set |= ResourceSet{1} << static_cast<unsigned>(it - names.begin());
  }
  return result;
}

std::string to_text(ResourceSet set, std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((set >> i & 1u) != 0) text.append(text.empty() ? "" : ";").append(names[i]);
  }
  return text;
}

}  // namespace lockstep::host
