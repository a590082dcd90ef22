// Whether a word is mistyped, where most words that are near are others: see suggest.h for a list
// of all that can be meant.
#pragma once

#include <string_view>

namespace lockstep::host {

// One edit (insert, delete, replace, swap of neighbors; case does not count) makes them the same,
// and one more for each eight letters.
bool is_typo_of(std::string_view word, std::string_view known);

// Whether the word is that one beyond doubt: only case, '_' and '-' differ, or in a word of six
// letters or more one letter is too many, missing or wrong, or two neighbors are swapped. A digit,
// a plural and a letter that is a word by itself are no slip: 'arm2' and 'move_x' are other things
// than 'arm1' and 'move_y', and so may be 'lift' and 'left'.
bool is_slip_of(std::string_view word, std::string_view known);

}  // namespace lockstep::host
