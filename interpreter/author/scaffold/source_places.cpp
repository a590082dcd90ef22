#include "author/scaffold/source_places.h"

#include <algorithm>
#include <regex>

#include "author/scaffold/code_mask.h"

namespace lockstep::host {
namespace {

// No part of a pattern is without a limit, since a match takes stack for each character, and a
// comment is as many blanks.
constexpr const char* kCppList = R"(\bLOCKSTEP_PLUGIN\()";
constexpr const char* kPythonImport = R"(\bfrom lockstep_leaf import\b[ \t]{0,99}\(?)";

// Where the last character that a pattern finds is.
std::size_t end_of_match(const std::string& mask, const char* pattern) {
  std::smatch match;
  if (!std::regex_search(mask, match, std::regex(pattern))) return kNowhere;
  return static_cast<std::size_t>(match.position(0) + match.length(0)) - 1;
}

std::size_t begin_of_line(const std::string& text, std::size_t at) {
  const auto before = at == 0 ? kNowhere : text.rfind('\n', at - 1);
  return before == kNowhere ? 0 : before + 1;
}

// Comments directly above a line belong to it.
std::size_t above_comments(const std::string& text, const std::string& mask, std::size_t line) {
  while (line > 0) {
    const auto above = begin_of_line(text, line - 1);
    const auto is_blank = [&](const std::string& it) {
      return it.find_first_not_of(kBlanks, above) >= line;
    };
    if (!is_blank(mask) || is_blank(text)) return line;
    line = above;
  }
  return line;
}

// In front of the end of the unnamed namespace above a line, if there is one.
std::size_t inside_namespace(const std::string& text, const std::string& mask, std::size_t line) {
  const auto last = line == 0 ? kNowhere : mask.find_last_not_of(kBlanks, line - 1);
  if (last == kNowhere || mask[last] != '}') return line;
  const auto begin = begin_of_line(text, last);
  static const std::regex kEnd(R"(\}\s*//\s*(anonymous )?namespace\s*)");
  return std::regex_match(text.substr(begin, text.find('\n', begin) - begin), kEnd) ? begin : line;
}

SourcePlaces places_in_python(const std::string& mask) {
  SourcePlaces places{.missing = "serve() at the begin of a line"};
  const auto call = mask.starts_with("serve()") ? 0 : mask.rfind("\nserve()");
  places.are_complete = call != kNowhere;
  if (places.are_complete) places.definition = call + (call == 0 ? 0 : 1);
  return places;
}

}  // namespace

// The definition goes in front of the line with the list of nodes.
SourcePlaces source_places(const PluginSource& source, const std::string& mask) {
  if (is_python(*source.language)) return places_in_python(mask);
  SourcePlaces places{.nodes = {.indentation = std::string(16, ' ')},
                      .missing = "LOCKSTEP_PLUGIN(…)"};
  places.nodes.open = end_of_match(mask, kCppList);
  if (places.nodes.open == kNowhere) return places;
  places.nodes.close = closing_bracket(mask, places.nodes.open);
  if (places.nodes.close == kNowhere) return places;
  const auto line = above_comments(source.text, mask, begin_of_line(mask, places.nodes.open));
  places.definition = inside_namespace(source.text, mask, line);
  places.are_complete = true;
  return places;
}

ItemList import_list(const std::string& mask) {
  ItemList list{.indentation = "    ", .may_stay_on_line = true};
  list.open = end_of_match(mask, kPythonImport);
  if (list.open == kNowhere) return list;
  list.close = mask[list.open] == '(' ? closing_bracket(mask, list.open)
                                      : std::min(mask.find('\n', list.open), mask.size());
  if (list.close == kNowhere) list.open = kNowhere;
  return list;
}

std::vector<std::string> names_used(const NewNode& node) {
  std::vector<std::string> names{node.kind == NewNodeKind::Condition ? "Condition" : "Action"};
  for (const NewPort& port : node.ports) {
    if (port.direction == PortDirection::Output) names.emplace_back("Output");
    if (port.direction == PortDirection::InOut) names.emplace_back("InOut");
  }
  return names;
}

}  // namespace lockstep::host
