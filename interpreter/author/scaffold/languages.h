// The languages in which `new` writes plugins: a row for each.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "base/core/value.h"

namespace lockstep::host {

enum class NewNodeKind { Action, Condition, Threaded, Control, Decorator };
std::string_view to_string(NewNodeKind kind);  // "action"

// How a language writes a type of ports.
struct PortType {
  ValueType type;
  std::string_view text;
};

struct SourceLanguage {
  std::string_view name;           // of templates and --lang
  std::string_view title;          // in sentences
  std::string_view extension;      // of a source
  std::string_view mark;           // what a source of a plugin has, and no other one
  std::string_view directions[3];  // of an input, an output, an inout
  // Where in a source the text of a node goes, in two halves: its definition, and its entry in the
  // list of nodes. None: `new leaf` inserts it.
  std::string_view definition_place, entry_place;
  std::vector<PortType> types;
  std::vector<NewNodeKind> kinds;
};

bool is_python(const SourceLanguage& language);
std::span<const SourceLanguage> source_languages();
const SourceLanguage* find_language(std::string_view name);

}  // namespace lockstep::host
