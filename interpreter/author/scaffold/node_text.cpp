#include "author/scaffold/node_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "author/scaffold/names.h"
#include "author/scaffold/port_value.h"
#include "author/scaffold/render.h"
#include "author/scaffold/taken_names.h"

namespace lockstep::host {
namespace {

// The names of the classes of a source are no members of them.
bool is_class_of(const NewNode& node, std::string_view name) {
  return name == node.id || name == node.id + "Ports";
}

// No word of C++ and no other member.
std::string member_of(const NewNode& node, const NewPort& port) {
  std::string member = port.name;
  const auto is_taken = [&] {
    const bool is_other_port =
        member != port.name && std::ranges::count(node.ports, member, &NewPort::name) != 0;
    return is_other_port || is_taken_in_cpp(member) || is_class_of(node, member);
  };
  while (is_taken()) member += "_port";
  return member;
}

Values port_values(const SourceLanguage& language, const NewNode& node, const NewPort& port) {
  const auto type = std::ranges::find(language.types, port.type, &PortType::type);
  const std::string_view direction = language.directions[static_cast<int>(port.direction)];
  const bool has_default = port.default_text.has_value();
  const bool is_output = port.direction == PortDirection::Output;
  Values values;
  values.texts = {{"name", port.name},
                  {"member", member_of(node, port)},
                  {"PORT", as_upper(as_lower_name(port.name))},
                  {"type", std::string(type->text)},
                  {"direction", std::string(direction)},
                  {"annotation", direction.empty() ? std::string(type->text)
                                                   : fmt::format("{}[{}]", direction, type->text)},
                  {"is_required", has_default || is_output ? "" : "yes"},
                  {"default", has_default ? "yes" : ""},
                  {"text", has_default ? in_quotes(*port.default_text) : ""},
                  {"value", has_default ? literal(language, *type, *port.default_text) : ""}};
  return values;
}

Result<void> check_ports(const SourceLanguage& language, const NewNode& node) {
  std::set<std::string> names;  // of constants in C and Rust
  for (const NewPort& port : node.ports) {
    if (!names.insert(as_upper(as_lower_name(port.name))).second) {
      return problem(fmt::format("two ports are called '{}'", port.name), "give each its own name");
    }
    const bool is_known =
        std::ranges::find(language.types, port.type, &PortType::type) != language.types.end();
    if (!is_known) {
      return problem(fmt::format("a plugin in {} has no ports of type '{}'", language.title,
                                 to_string(port.type)),
                     "take another type, or another language");
    }
    if (is_python(language) && is_taken_in_python(port.name)) {
      return problem(fmt::format("a port in Python cannot be called '{}'", port.name),
                     fmt::format("leaves have it already, or the language: '{}_port'", port.name));
    }
  }
  return {};
}

Result<void> check_node(const SourceLanguage& language, const NewNode& node) {
  if (const auto id = check_node_id(node.id); !id) return id;
  if (std::ranges::find(language.kinds, node.kind) == language.kinds.end()) {
    const bool is_threaded = node.kind == NewNodeKind::Threaded;
    return problem(fmt::format("a plugin in {} has no {}", language.title,
                               is_threaded ? "threaded actions"
                                           : std::string(to_string(node.kind)) + " nodes"),
                   "a plugin in C++ has: lockstep new plugin NAME");
  }
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (std::ranges::any_of(node.doc, is_control)) {
    return problem("the text of --doc has more than one line", "write one sentence");
  }
  return check_ports(language, node);
}

Values node_values(const SourceLanguage& language, const NewNode& node) {
  const std::string lower = as_lower_name(node.id);
  Values values;
  values.texts = {{"leaf", node.id},
                  {"lower", lower},
                  {"UPPER", as_upper(lower)},
                  {"KIND", as_upper(std::string(to_string(node.kind)))},
                  {"doc", in_quotes(node.doc.empty() ? as_sentence(node.id) : node.doc)},
                  {"is_" + std::string(to_string(node.kind)), "yes"},
                  {"has_ports", node.ports.empty() ? "" : "yes"}};
  std::vector<Values>& ports = values.lists["ports"];
  for (const NewPort& port : node.ports) ports.push_back(port_values(language, node, port));
  if (!ports.empty()) ports.back().texts["is_last"] = "yes";
  return values;
}

std::string without_end(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

Result<NodeText> node_text(const SourceLanguage& language, const NewNode& node) {
  if (const auto checked = check_node(language, node); !checked)
    return tl::unexpected(checked.error());
  const Values values = node_values(language, node);
  const std::string name = "leaf/" + std::string(language.name);
  return NodeText{render(name, values),
                  is_python(language) ? "" : without_end(render(name + ".entry", values))};
}

}  // namespace lockstep::host
