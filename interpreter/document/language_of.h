// The language in which an XML text is written: what the attributes of its root say.
#pragma once

#include <string_view>

#include "core/language.h"

namespace lockstep {

// Lockstep where no language can be recognized.
Language language_of(std::string_view text);

}  // namespace lockstep
