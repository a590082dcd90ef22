// Whether a word is mistyped, where most words that are near are others: see suggest.h for a list
// of all that can be meant.
#pragma once

#include <string_view>

namespace lockstep::host {

// One edit (insert, delete, replace, swap of neighbors; case does not count) makes them the same,
// and one more for each eight letters.
bool is_typo_of(std::string_view word, std::string_view known);

// Whether the word is that one beyond doubt: only case, '_' and '-' differ, or in a part of many
// letters one is missing or too many, not at its begin or end, or two neighbors are swapped.
// Another letter makes another word too often: 'arm2' and 'arm1', 'charge' and 'change'. So does
// one at the begin or the end: 'locked' and 'blocked'.
bool is_slip_of(std::string_view word, std::string_view known);

}  // namespace lockstep::host
