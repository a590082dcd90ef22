#include "author/convert/declared_arguments.h"

#include "base/core/pre_order.h"

namespace lockstep::host {

DeclaredArguments::DeclaredArguments(const Document& document) {
  const auto elements = document.elements();
  for (const std::uint32_t child : children_in(elements, 0)) {
    const Attribute* name = document.find_attribute(child, "name");
    if (elements[child].tag != "arg" || name == nullptr) continue;
    defaults_.emplace(name->value, document.find_attribute(child, "default"));  // the first
  }
}

std::string DeclaredArguments::with_defaults(std::string_view text) const {
  std::string all;
  std::size_t end = 0;
  for_each_in(text, [&](std::size_t at, std::string_view name) {
    const auto found = defaults_.find(name);
    if (found == defaults_.end() || found->second == nullptr) return;
    all.append(text.substr(end, at - end)).append(found->second->value);
    end = at + name.size() + 3;
  });
  return all.append(text.substr(end));
}

}  // namespace lockstep::host
