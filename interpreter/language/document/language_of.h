// The language in which an XML text is written: what the attributes of its root say.
#pragma once

#include <string_view>

#include "base/core/language.h"

namespace lockstep::host {

// The own one where no language can be recognized.
const LanguageRules& language_of(std::string_view text);

}  // namespace lockstep::host
