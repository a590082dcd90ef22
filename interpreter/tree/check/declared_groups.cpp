#include "tree/check/declared_groups.h"

#include <fmt/format.h>

#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "tree/check/attributes.h"
#include "tree/check/node_check.h"

namespace lockstep::host {

void DeclaredGroups::check(std::uint32_t number, std::uint32_t index, const NodeType& type) {
  const Document& document = *project_.documents[number];
  const Element& element = document.elements()[index];
  const auto attributes = document.attributes(index);
  if (element.end > index + 1) {
    report_.at("unexpected-element"_code, document.elements()[index + 1].place,
               fmt::format("'{}' cannot contain elements", type.id));
  }
  CheckedNode group;
  group.type = &type;
  group.place = element.place;
  check_attributes({group.place, attributes, false}, report_, group, layouts_, trees_);
  keep_written({group.place, attributes, false}, group, trees_);
  const Attribute* name = find_attribute(attributes, "name");
  if (name == nullptr) {
    report_.at("missing-attribute"_code, group.place,
               fmt::format("'{}' needs the attribute 'name'", type.id),
               fmt::format("write <{} name=\"…\">: the nodes of the trees refer to it", type.id));
  } else if (!is_identifier(name->value)) {
    report_.at_value("bad-name"_code, name->place,
                     fmt::format("'{}' is not a name for '{}'", brief(name->value), type.id),
                     fmt::format("such a name is {}", kIdentifierRule));
  } else {
    group.name = name->value;
    enter(group, project_.prefixes[number], name->place);
  }
}

void DeclaredGroups::enter(CheckedNode& group, std::string_view prefix, Place name) {
  if (!prefix.empty())
    group.name = trees_.texts.emplace_back(fmt::format("{}{}", prefix, group.name));
  const auto [first, is_new] = places_.try_emplace(group.name, group.place);
  if (is_new) {
    trees_.groups.push_back(group);
    return;
  }
  report_.at_value(
      "duplicate-name"_code, name,
      fmt::format("the name '{}' is declared already", brief(group.name)),
      fmt::format("the first is at {}", to_text(project_.sources.locate(first->second))));
}

}  // namespace lockstep::host
