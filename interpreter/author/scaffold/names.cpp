#include "author/scaffold/names.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/identifier.h"

namespace lockstep::host {
namespace {

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
char lowered(char c) {
  return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
}
char raised(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

// The words of an ID, each with `separator` in front, but the first one: those of HTTPServer are
// HTTP and Server.
std::string in_words(std::string_view id, char separator) {
  std::string words;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const bool after_small = i > 0 && !is_upper(id[i - 1]) && id[i - 1] != '_';
    const bool before_small = i + 1 < id.size() && id[i + 1] >= 'a' && id[i + 1] <= 'z';
    const bool begins =
        i > 0 && id[i - 1] != '_' && is_upper(id[i]) && (after_small || before_small);
    if (begins) words += separator;
    words += id[i] == '_' ? separator : lowered(id[i]);
  }
  return words;
}

// Targets that CMake makes itself.
constexpr std::string_view kTakenTargets[] = {"all",        "clean",         "default", "depend",
                                              "edit_cache", "help",          "install", "lockstep",
                                              "package",    "rebuild_cache", "test"};
// Sources of plugins use these words, they are keywords of a language, or tags of trees that are no
// nodes.
constexpr std::string_view kTakenIds[] = {"Action",        "BehaviorTree",  "Condition",
                                          "ConditionNode", "Control",       "ControlNode",
                                          "Decorator",     "DecoratorNode", "StatefulActionNode",
                                          "False",         "Here",          "InOut",
                                          "Input",         "Leaf",          "LeafType",
                                          "Lockstep",      "None",          "Output",
                                          "Plugin",        "Port",          "Ports",
                                          "PortsType",     "Self",          "Status",
                                          "SubTree",       "Token",         "TreeNodesModel",
                                          "True",          "Type"};

// Macros of headers are called so: EOF, M_PI, L_tmpnam. No list has them all.
bool is_like_a_macro(std::string_view id) {
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  return id.substr(1).starts_with('_') || std::ranges::none_of(id, is_small);
}

std::string without_capitals(std::string_view id) {
  std::string words;
  for (const char c : id) words += words.empty() || words.back() == '_' ? c : lowered(c);
  return as_class_name(words);
}

}  // namespace

Result<void> check_file_name(std::string_view what, std::string_view name) {
  if (std::ranges::find(kTakenTargets, name) != std::end(kTakenTargets)) {
    return problem(fmt::format("a {} cannot be called '{}'", what, name),
                   "that name is CMake's, or lockstep's; take another one");
  }
  const auto is_part = [](char c) { return is_identifier({&c, 1}) || is_digit(c) || c == '-'; };
  if (!name.empty() && is_identifier(name.substr(0, 1)) && std::ranges::all_of(name, is_part)) {
    return {};
  }
  return problem(fmt::format("'{}' cannot be the name of a {}", name, what),
                 "a letter, then letters, digits, '_' or '-', such as 'left_arm'");
}

Result<void> check_node_id(std::string_view id) {
  const bool is_legal = is_identifier(id) && id[0] != '_' && id.find("__") == id.npos;
  if (!is_legal) {
    return problem(fmt::format("'{}' cannot be the name of a node", id),
                   "a letter, then letters, digits or '_', such as 'OpenDoor'");
  }
  if (std::ranges::find(kTakenIds, id) != std::end(kTakenIds)) {
    return problem(fmt::format("a node cannot be called '{}'", id),
                   "sources or trees have that word already");
  }
  if (!is_upper(id[0])) {
    return problem(fmt::format("'{}' begins with a lowercase letter, but it becomes a class", id),
                   fmt::format("call it '{}'", as_class_name(id)));
  }
  if (is_like_a_macro(id)) {
    const std::string other = without_capitals(id);
    return problem(fmt::format("'{}' is written as macros of C are, and may be one", id),
                   is_like_a_macro(other) ? "a name with small letters, such as 'OpenDoor'"
                                          : fmt::format("call it '{}'", other));
  }
  return {};
}

std::string as_class_name(std::string_view name) {
  std::string made;
  bool begins = true;
  for (const char c : name) {
    const bool separates = c == '_' || c == '-';
    if (!separates) made += begins ? raised(c) : c;
    begins = separates;
  }
  return made;
}

std::string as_lower_name(std::string_view id) {
  return in_words(id, '_');
}

std::string as_sentence(std::string_view id) {
  std::string text = in_words(id, ' ');
  text[0] = raised(text[0]);
  return text;
}

std::string as_upper(std::string text) {
  std::ranges::transform(text, text.begin(), raised);
  return text;
}

}  // namespace lockstep::host
