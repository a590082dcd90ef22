// An editor draws these into the text: commands above trees, values behind attributes and nodes.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

Json code_lenses(const Question& question);
Json inlay_hints(const Question& question);

}  // namespace lockstep::host
