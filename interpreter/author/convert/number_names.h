// Names in scripts for numbers that a program registers, as RED or STATE_OK. lockstep's language
// has none: there, such a name is an entry.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

#include "author/convert/convert.h"

namespace lockstep::host {

// Whether it is written as such names are. Entries may be, too.
bool is_in_upper_case(std::string_view name);

class NumberNames {
 public:
  // `document`: what is converted.
  NumberNames(const Document& document, const Conversion& conversion);

  // Whether `name` can be no entry: nothing in the files assigns it, or names it as one.
  bool has(std::string_view name) const {
    return is_in_upper_case(name) && !entries_.contains(std::string(name));
  }

 private:
  void find_entries(const Document& document, const Conversion& conversion);
  void find_assigned(std::string_view script);
  void find_keys(std::string_view text);
  void add(std::string_view name);

  std::unordered_set<std::string> entries_;  // in upper case
};

}  // namespace lockstep::host
