// The words of leaf files and of scenarios (leaves/leaf_words.h) as parts of an XML schema.
#pragma once

#include <string>
#include <string_view>

#include "leaves/leaf_words.h"

namespace lockstep::host {

std::string xsd_documented(std::string_view text);
// `or_else` is another pattern that each value may have; "": there is none.
std::string xsd_attribute(const leaf_words::Word& word, std::string_view or_else = {});

}  // namespace lockstep::host
