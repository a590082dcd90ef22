// Quick fixes, which are what mends messages, and refactorings.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

// Whether a client that asks for `kinds` wants code actions of this one. A kind has those below it:
// "refactor" has "refactor.extract".
bool is_wanted(std::string_view kind, const std::vector<std::string>& kinds);

Json code_actions(const Question& question);

}  // namespace lockstep::host
