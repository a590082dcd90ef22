// From a name to where it is declared, and to all places that use it.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

Json definition(const Question& question);
Json references(const Question& question);
Json highlights(const Question& question);

}  // namespace lockstep::host
