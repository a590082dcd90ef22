// Whether a word is mistyped, where most words that are near are others: see suggest.h for a list
// of all that can be meant.
#pragma once

#include <string_view>

namespace lockstep::host {

// One edit (insert, delete, replace, swap of neighbors; case does not count) makes them the same,
// and one more for each eight letters.
bool is_typo_of(std::string_view word, std::string_view known);

}  // namespace lockstep::host
