#include "author/scaffold/source_places.h"

#include <algorithm>
#include <array>
#include <regex>

#include "author/scaffold/code_mask.h"

namespace lockstep::host {
namespace {

// How a language lists the nodes of a plugin. No part of a pattern is without a limit, since a
// match takes stack for each character, and a comment is as many blanks. The last character that
// `list` finds is the bracket; the definition of a node goes in front of the last line before it
// that begins with `mark`.
struct Listing {
  std::string_view language;
  const char* list;
  std::string_view mark;
  ItemList items;
  const char* description;
};

const std::array<Listing, 4>& listings() {
  static const std::array<Listing, 4> all{
      {{"cpp",
        R"(\bLOCKSTEP_PLUGIN\()",
        "LOCKSTEP_PLUGIN(",
        {kNowhere, kNowhere, Separator::Comma, std::string(16, ' '), false},
        "LOCKSTEP_PLUGIN(…)"},
       {"btcpp",
        R"(\bBT_REGISTER_NODES\([^)]{0,200}\)\s{0,200}\{)",
        "BT_REGISTER_NODES(",
        {kNowhere, kNowhere, Separator::Line, "  ", false},
        "BT_REGISTER_NODES(…) {…}"},
       {"c",
        R"(lockstep_leaf_type\s{0,9}\*\s{0,9}const\s{1,9}\w{1,99}\s{0,9}\[\w{0,99}\]\s{0,9}=\s{0,99}\{)",
        "",
        {kNowhere, kNowhere, Separator::Comma, "    ", true},
        "a list of lockstep_leaf_type* const"},
       {"rust",
        R"(\bPlugin::of\([^;]{0,2000}?&\[)",
        "#[no_mangle]",
        {kNowhere, kNowhere, Separator::Comma, "    ", true},
        "#[no_mangle] and Plugin::of(…, &[…])"}}};
  return all;
}

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

SourcePlaces source_places(const PluginSource& source, const std::string& mask) {
  const auto listing = std::ranges::find(listings(), source.language->name, &Listing::language);
  if (listing == listings().end()) return places_in_python(mask);
  SourcePlaces places{.nodes = listing->items, .missing = listing->description};
  places.nodes.open = end_of_match(mask, listing->list);
  if (places.nodes.open == kNowhere) return places;
  places.nodes.close = closing_bracket(mask, places.nodes.open);
  const auto mark =
      listing->mark.empty() ? places.nodes.open : mask.rfind(listing->mark, places.nodes.open);
  if (mark == kNowhere || places.nodes.close == kNowhere) return places;
  const auto line = above_comments(source.text, mask, begin_of_line(mask, mark));
  places.definition = inside_namespace(source.text, mask, line);
  places.are_complete = true;
  return places;
}

ItemList import_list(const PluginSource& source, const std::string& mask) {
  ItemList list{.indentation = "    ", .may_stay_on_line = true};
  const bool is_rust = source.language->name == "rust";
  const char* const import =
      is_rust ? R"(\buse lockstep::\{)" : R"(\bfrom lockstep_leaf import\b[ \t]{0,99}\(?)";
  list.open = end_of_match(mask, import);
  if (list.open == kNowhere) return list;
  const bool has_bracket = mask[list.open] == '(' || mask[list.open] == '{';
  list.close = has_bracket ? closing_bracket(mask, list.open)
                           : std::min(mask.find('\n', list.open), mask.size());
  if (list.close == kNowhere) list.open = kNowhere;
  return list;
}

std::vector<std::string> names_used(const SourceLanguage& language, const NewNode& node) {
  const bool is_condition = node.kind == NewNodeKind::Condition, is_rust = language.name == "rust";
  std::vector<std::string> names{is_condition ? "Condition" : "Action"};
  if (is_rust) {
    names.insert(names.end(), {"Here", "LeafType"});
    if (!is_condition) names.emplace_back("Status");
    if (!node.ports.empty()) names.insert(names.end(), {"Port", "Type"});
    return names;
  }
  for (const NewPort& port : node.ports) {
    if (port.direction == PortDirection::Output) names.emplace_back("Output");
    if (port.direction == PortDirection::InOut) names.emplace_back("InOut");
  }
  return names;
}

}  // namespace lockstep::host
