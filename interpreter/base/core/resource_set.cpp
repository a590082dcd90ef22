#include "base/core/resource_set.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {
namespace {

constexpr std::string_view kBetweenNames = ";, \t\r\n";
constexpr std::string_view kAny = "any(";

}  // namespace

std::string_view ResourceNames::next() {
  while (true) {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBetweenNames), rest_.size()));
    if (rest_.starts_with(kAny)) {
      rest_.remove_prefix(kAny.size());
      is_choice_ = true;
      ++choices_;
    } else if (is_choice_ && rest_.starts_with(')')) {
      rest_.remove_prefix(1);
      is_choice_ = false;
    } else {
      break;
    }
  }
  auto end = rest_.find_first_of(kBetweenNames);
  if (is_choice_) end = std::min(end, rest_.find(')'));
  const std::string_view name = rest_.substr(0, end);
  rest_.remove_prefix(name.size());
  return name;
}

std::vector<std::string_view> resource_names(std::string_view list) {
  std::vector<std::string_view> found;
  ResourceNames names(list);
  for (auto name = names.next(); !name.empty(); name = names.next()) found.push_back(name);
  return found;
}

ResourceList resource_list(std::string_view list, std::span<const std::string> names) {
  ResourceList result;
  ResourceNames reader(list);
  for (auto name = reader.next(); !name.empty(); name = reader.next()) {
    const auto it = std::ranges::find(names, name);
    if (it == names.end()) {
      result.unknown = name;
      return result;
    }
    const ResourceSet bit = ResourceSet{1} << static_cast<unsigned>(it - names.begin());
    const bool is_choice = reader.is_choice() && result.count < result.sets.size();
    double& set = is_choice ? result.sets[result.count++] : result.sets[0];
    set = static_cast<double>(static_cast<ResourceSet>(set) | bit);
  }
  return result;
}

ResourceSet all_resources(std::span<const double> request) {
  ResourceSet all = 0;
  for (const double set : request) all |= static_cast<ResourceSet>(set);
  return all;
}

std::string to_text(ResourceSet set, std::span<const std::string> names) {
  std::string text;
  to_text(set, names, text);
  return text;
}

void to_text(ResourceSet set, std::span<const std::string> names, std::string& text) {
  text.clear();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((set >> i & 1u) != 0) text.append(text.empty() ? "" : ";").append(names[i]);
  }
}

bool is_text_of(std::string_view text, ResourceSet set, std::span<const std::string> names) {
  bool is_first = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((set >> i & 1u) == 0) continue;
    if (!is_first && !text.starts_with(';')) return false;
    if (!std::exchange(is_first, false)) text.remove_prefix(1);
    if (!text.starts_with(names[i])) return false;
    text.remove_prefix(names[i].size());
  }
  return text.empty();
}

}  // namespace lockstep::host
