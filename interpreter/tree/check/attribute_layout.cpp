#include "tree/check/attribute_layout.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lockstep::host {
namespace {

std::vector<std::uint32_t> add_defaults(const NodeType& type, std::vector<Value>& values) {
  std::vector<std::uint32_t> defaults;
  for (const Parameter& it : type.parameters) {
    defaults.push_back(AttributeLayout::kNone);
    if (!it.default_text) continue;
    defaults.back() = static_cast<std::uint32_t>(values.size());
    values.push_back(*parse_value(it.type, *it.default_text));
  }
  return defaults;
}

void look_up_names(const NodeType& type, const LanguageRules& rules, AttributeLayout& layout) {
  layout.name = AttributeLayout::kNone;
  layout.has_unknown = layout.has_hooks = layout.has_at_cut = false;
  for (std::uint32_t i = 0; i < layout.names.size(); ++i) {
    const std::string_view name = layout.names[i];
    if (name == "name") layout.name = i;
    // Nodes that are declared beside the trees are never ticked.
    const bool is_hook = type.category != NodeCategory::Group && hook_named(name, rules);
    layout.has_hooks |= is_hook;
    const bool is_at_cut = type.category == NodeCategory::Action && is_of_actions(name, rules);
    layout.has_at_cut |= is_at_cut;
    const bool names_type = layout.is_explicit && name == "ID";
    layout.has_unknown |=
        !is_common_attribute(name) && !names_type && !is_hook && !is_at_cut &&
        std::ranges::find(type.parameters, name, &Parameter::name) == type.parameters.end();
  }
}

void place_parameters(const NodeType& type, AttributeLayout& layout) {
  layout.given.clear();
  layout.ports.assign(type.parameters.size(), {});
  for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
    const Parameter& parameter = type.parameters[i];
    const auto found = std::ranges::find(layout.names, parameter.name);
    if (found != layout.names.end()) {
      layout.given.push_back({i, static_cast<std::uint32_t>(found - layout.names.begin())});
    } else if (!parameter.default_key.empty() || (parameter.required && !parameter.default_text)) {
      layout.given.push_back({i, AttributeLayout::kNone});
    } else {
      layout.ports[i].value = layout.defaults[i];
    }
  }
}

}  // namespace

bool AttributeLayout::fits(const NodeElement& element) const {
  const auto attributes = element.attributes;
  if (is_explicit != element.is_explicit || names.size() != attributes.size()) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string_view other = attributes[i].name;
    // This is == without a call, since it is done for each attribute of a tree.
    if (other.size() != names[i].size()) return false;
    if (std::memcmp(other.data(), names[i].data(), other.size()) != 0) return false;
  }
  return true;
}

AttributeLayout& AttributeLayouts::of(const NodeElement& element, const NodeType& type,
                                      CheckedTrees& trees) {
  bool is_known = true;
  if (&type != last_type_) {
    const auto [entry, is_new] = last_.try_emplace(&type);
    is_known = !is_new;
    last_type_ = &type;
    last_of_type_ = &entry->second;
    if (is_new) {
      last_of_type_->defaults = add_defaults(type, trees.values);
      last_of_type_->last.resize(type.parameters.size());
    }
  }
  AttributeLayout& layout = *last_of_type_;
  if (is_known && layout.fits(element)) return layout;
  layout.is_explicit = element.is_explicit;
  layout.names.clear();
  for (const Attribute& it : element.attributes) layout.names.push_back(it.name);
  look_up_names(type, *trees.rules, layout);
  place_parameters(type, layout);
  return layout;
}

}  // namespace lockstep::host
