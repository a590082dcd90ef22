// Where the parts of a node go in the source of a plugin.
#pragma once

#include <string>
#include <vector>

#include "author/scaffold/plugin_source.h"

namespace lockstep::host {

inline constexpr auto kNowhere = std::string::npos;
inline constexpr const char* kBlanks = " \t\r\n";

// A list in brackets.
struct ItemList {
  std::size_t open = kNowhere;  // the bracket, or the last letter in front of the list
  std::size_t close = kNowhere;
  std::string indentation = {};   // of an item on its own line
  bool may_stay_on_line = false;  // if all others are on the line of the bracket
};

struct SourcePlaces {
  std::size_t definition = kNowhere;  // the begin of a line
  ItemList nodes = {};
  bool are_complete = false;
  std::string missing = {};  // what was looked for
};

// `mask` is the code of the source.
SourcePlaces source_places(const PluginSource& source, const std::string& mask);

// The list of names that a source in Python imports from lockstep.
ItemList import_list(const std::string& mask);
// The names that the text of a node needs.
std::vector<std::string> names_used(const NewNode& node);

}  // namespace lockstep::host
