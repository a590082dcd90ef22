// Checks the attributes of an element of a leaf file or a scenario against the words that it may
// have (leaves/leaf_words.h).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "language/document/document.h"
#include "language/document/reporter.h"
#include "leaves/leaf_words.h"

namespace lockstep::host {

// The parts of a text; one part if `between` is not in it.
std::vector<std::string_view> split(std::string_view text, std::string_view between);

// Reports unknown names, empty values, values that are none of a choice, and required attributes
// that are missing. Names that begin with `open` may be any; "": there are none. False: an
// attribute is missing, or is none of its choice.
bool check_words(const Document& document, std::uint32_t element, std::string_view open,
                 std::span<const leaf_words::Word> words, const Reporter& report);

}  // namespace lockstep::host
