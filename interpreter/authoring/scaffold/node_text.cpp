#include "authoring/scaffold/node_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "authoring/scaffold/names.h"
#include "authoring/scaffold/port_value.h"
#include "authoring/scaffold/render.h"

namespace lockstep::host {
namespace {

// Members of the classes that leaves in C++ derive from, words of C++, and what a template has.
constexpr std::array<std::string_view, 41> kTakenMembers{
    "tick",   "start",    "halt",   "pause",   "resume",   "progress", "check",
    "log",    "now",      "random", "uniform", "wake",     "context",  "required",
    "run",    "begin",    "finish", "class",   "struct",   "default",  "double",
    "float",  "int",      "bool",   "char",    "long",     "short",    "new",
    "delete", "this",     "for",    "while",   "do",       "if",       "else",
    "switch", "operator", "return", "public",  "template", "namespace"};
// Attributes that leaves in Python have beside ports, and words of Python.
constexpr std::array<std::string_view, 24> kTakenAttributes{
    "clock", "halt",     "kind",   "log",       "now",    "path",  "pause", "period",
    "tick",  "progress", "random", "real_time", "resume", "start", "from",  "in",
    "is",    "lambda",   "class",  "def",       "if",     "for",   "pass",  "import"};

bool is_python(const SourceLanguage& language) {
  return language.name == "python";
}

Values port_values(const SourceLanguage& language, const NewPort& port) {
  const auto type = std::ranges::find(language.types, port.type, &PortType::type);
  const std::string_view direction = language.directions[static_cast<int>(port.direction)];
  const bool has_default = port.default_text.has_value();
  const bool is_output = port.direction == PortDirection::Output;
  const bool is_taken = std::ranges::find(kTakenMembers, port.name) != kTakenMembers.end();
  Values values;
  values.texts = {{"name", port.name},
                  {"member", port.name + (is_taken || port.name.ends_with('_') ? "_port" : "")},
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
    const bool is_taken = std::ranges::find(kTakenAttributes, port.name) != kTakenAttributes.end();
    if (is_python(language) && is_taken) {
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
  for (const NewPort& port : node.ports) ports.push_back(port_values(language, port));
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
