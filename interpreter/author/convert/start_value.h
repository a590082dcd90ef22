// A text that a SubTree gives an entry of its tree, as it starts with the same value there. There,
// a number is one, and every other text is a text, unless a port inside has a type.
#pragma once

#include <string>
#include <string_view>

#include "author/convert/entry_types.h"

namespace lockstep::host {

struct ConvertedStart {
  std::string text;
  std::string difference = {};  // why it may be another value there; "": it is not
};

ConvertedStart start_to_theirs(std::string_view text, const EntryTypes::Found& entry);

}  // namespace lockstep::host
