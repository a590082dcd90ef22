// The words of scripts, of {keys} and of ${arguments}, for an editor that colors them.
#pragma once

#include "author/server/features/feature.h"

namespace lockstep::host {

Json script_tokens(const Question& question);
Json script_token_legend();

}  // namespace lockstep::host
